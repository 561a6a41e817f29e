#include "landfall/error.hpp"

namespace landfall {

const char* to_string(ErrorCode code) {
  switch (code) {
    case ErrorCode::invalid_argument:
      return "invalid argument";
    case ErrorCode::unknown_name:
      return "unknown name";
    case ErrorCode::file_not_found:
      return "file not found";
    case ErrorCode::file_format:
      return "file format";
    case ErrorCode::file_write:
      return "file write";
    case ErrorCode::too_large:
      return "too large";
  }
  return "unknown";
}

}  // namespace landfall
