#include "tests/fuzz/fuzz.hpp"

namespace landfall::fuzz {

void test_one_input(std::string_view yaml) {
  expect_answer_or_error([&] { return io::read_places(yaml, "floor.places.yaml"); },
                         [](const std::map<std::string, PosePrior>& places) {
                           for (const auto& [name, place] : places) validate(place);
                         });
}

}  // namespace landfall::fuzz
