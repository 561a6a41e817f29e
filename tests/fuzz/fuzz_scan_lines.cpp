#include "tests/fuzz/fuzz.hpp"

namespace landfall::fuzz {

void test_one_input(std::string_view text) {
  expect_answer_or_error([&] { return io::read_scan_lines({text, "drive.jsonl"}, {}); }, check_log);
}

}  // namespace landfall::fuzz
