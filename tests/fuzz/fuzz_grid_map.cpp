// A map's yaml and, behind a NUL, its image of any format.
#include "tests/fuzz/fuzz.hpp"

namespace landfall::fuzz {

void test_one_input(std::string_view input) {
  const TwoTexts files = split(input);
  const auto image = [&](const std::string&) { return std::string(files.second); };
  expect_answer_or_error([&] { return io::read_grid_map(files.first, "floor.yaml", image); }, check_map);
}

}  // namespace landfall::fuzz
