#include "tests/fuzz/fuzz.hpp"

namespace landfall::fuzz {

void test_one_input(std::string_view text) {
  expect_answer_or_error([&] { return io::read_carmen({text, "drive.log"}, {}); }, check_log);
}

}  // namespace landfall::fuzz
