// The one exception of the library: the caller's or a file's fault, said once and completely.
#pragma once

#include <stdexcept>
#include <string>

namespace landfall {

enum class ErrorCode {
  invalid_argument,  // a value given by the caller is outside what the function accepts
  unknown_name,      // a method, option, sensor, place or instruction set that does not exist
  file_not_found,    // a file is missing or cannot be opened
  file_format,       // a file is truncated or holds something else than its format allows
  file_write,        // a result could not be written
  too_large,         // a size is beyond what is taken before memory is
};

const char* to_string(ErrorCode code);

// what() names the file, line, field, the value found and what was expected, where they apply.
class Error : public std::runtime_error {
 public:
  Error(ErrorCode code, const std::string& message) : std::runtime_error(message), code_(code) {}
  [[nodiscard]] ErrorCode code() const noexcept { return code_; }

 private:
  ErrorCode code_;
};

}  // namespace landfall
