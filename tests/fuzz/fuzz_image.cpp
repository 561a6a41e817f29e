// An image alone, under a yaml that is fine: netpbm and png.
#include "tests/fuzz/fuzz.hpp"

namespace landfall::fuzz {

void test_one_input(std::string_view bytes) {
  constexpr const char* yaml = "image: a\nresolution: 1\norigin: [0, 0, 0]\nmode: scale\n";
  const auto image = [&](const std::string&) { return std::string(bytes); };
  expect_answer_or_error([&] { return io::read_grid_map(yaml, "floor.yaml", image); }, check_map);
}

}  // namespace landfall::fuzz
