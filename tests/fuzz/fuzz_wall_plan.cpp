#include "tests/fuzz/fuzz.hpp"

namespace landfall::fuzz {

void test_one_input(std::string_view json) {
  expect_answer_or_error([&] { return io::read_wall_map(json, "plan.json"); },
                         [](const WallMap& map) { validate(map); });
}

}  // namespace landfall::fuzz
