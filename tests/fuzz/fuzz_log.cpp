// Any log, gzipped or not, told by its content.
#include "engine/io/file.hpp"
#include "tests/fuzz/fuzz.hpp"

namespace landfall::fuzz {

void test_one_input(std::string_view bytes) {
  const auto read = [&] {
    const std::string text = io::is_gzip(bytes) ? io::gunzip(bytes, "log") : std::string(bytes);
    return io::read_log({text, "log"}, {});
  };
  expect_answer_or_error(read, check_log);
}

}  // namespace landfall::fuzz
