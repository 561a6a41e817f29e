// A sensor file: yaml, or the sensor lines of a log.
#include "tests/fuzz/fuzz.hpp"

namespace landfall::fuzz {

void test_one_input(std::string_view text) {
  const auto check = [](const io::SensorsByName& sensors) {
    for (const auto& [name, sensor] : sensors) validate(*sensor);
  };
  expect_answer_or_error([&] { return io::read_sensors_yaml(text, "sensor.yaml"); }, check);
  expect_answer_or_error([&] { return io::read_sensor_lines(text, "drive.jsonl"); }, check);
}

}  // namespace landfall::fuzz
