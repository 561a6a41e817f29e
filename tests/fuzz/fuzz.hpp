// What every fuzzer asks of a reader: an answer that `check` accepts, or an Error. Anything else (another
// exception, a sanitizer's report, much memory or time) is a finding.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

#include "engine/io/readers.hpp"
#include "landfall/error.hpp"

namespace landfall::fuzz {

// Each fuzzer defines this; entry.cpp calls it.
void test_one_input(std::string_view input);

// `read` may throw Error; `check`, which looks at what it accepted, may not.
template <typename Read, typename Check>
void expect_answer_or_error(Read read, Check check) {
  std::optional<decltype(read())> answer;
  try {
    answer = read();
  } catch (const Error&) {
    return;
  }
  check(*answer);
}

// For readers of two files: what is before and after the input's first NUL.
struct TwoTexts {
  std::string_view first;
  std::string_view second;
};
inline TwoTexts split(std::string_view input) {
  const std::size_t nul = input.find('\0');
  if (nul == std::string_view::npos) return {input, {}};
  return {input.substr(0, nul), input.substr(nul + 1)};
}

inline void check_map(const GridMap& map) {
  validate(map);
}
inline void check_log(const Log& log) {
  for (const Scan& scan : log.scans) validate(scan);
}

}  // namespace landfall::fuzz
