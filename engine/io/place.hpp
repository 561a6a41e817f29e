// Where in a file something was found: every complaint of a reader is made here.
#pragma once

#include <string>
#include <string_view>

#include "landfall/error.hpp"

namespace landfall::io {

struct Place {
  std::string file;
  int line = 0;  // counted from 1; 0: the file as a whole
};

// "floor.yaml:2", or the file alone.
std::string to_string(const Place& place);
// A value from a file as it may be shown: at most 40 characters, control characters as '?', in quotes.
std::string shown(std::string_view value);
// The shortest text that reads back as the same number.
std::string shown(double value);

// Throws Error{file_format}: "floor.yaml:2: resolution: found 'x', expected a positive number".
[[noreturn]] void fail_format(const Place& place, std::string_view field, const std::string& found,
                              std::string_view expected, ErrorCode code = ErrorCode::file_format);

}  // namespace landfall::io
