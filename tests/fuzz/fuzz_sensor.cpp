#include "tests/fuzz/fuzz.hpp"

namespace landfall::fuzz {

void test_one_input(std::string_view yaml) {
  const auto check = [](const io::SensorsByName& sensors) {
    for (const auto& [name, sensor] : sensors) validate(*sensor);
  };
  expect_answer_or_error([&] { return io::read_sensors_yaml(yaml, "sensor.yaml"); }, check);
}

}  // namespace landfall::fuzz
