// The table of ranges and, behind a NUL, that of the poses; or the other table, of 24 columns.
#include "tests/fuzz/fuzz.hpp"

namespace landfall::fuzz {

void test_one_input(std::string_view input) {
  const TwoTexts tables = split(input);
  const auto read = [&] {
    if (tables.first.find(',') != std::string_view::npos)
      return io::read_scitos24({tables.first, "s.csv"}, {});
    return io::read_corridor8({tables.first, "ranges.txt"}, {tables.second, "poses.txt"}, {});
  };
  expect_answer_or_error(read, check_log);
}

}  // namespace landfall::fuzz
