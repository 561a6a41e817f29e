#include <exception>

#include "bindings/c/handles.hpp"

namespace landfall::c {
namespace {

thread_local std::string last_error;

landfall_status to_c(ErrorCode code) {
  switch (code) {
    case ErrorCode::invalid_argument:
      return LANDFALL_INVALID_ARGUMENT;
    case ErrorCode::unknown_name:
      return LANDFALL_UNKNOWN_NAME;
    case ErrorCode::file_not_found:
      return LANDFALL_FILE_NOT_FOUND;
    case ErrorCode::file_format:
      return LANDFALL_FILE_FORMAT;
    case ErrorCode::file_write:
      return LANDFALL_FILE_WRITE;
    case ErrorCode::too_large:
      return LANDFALL_TOO_LARGE;
  }
  return LANDFALL_INTERNAL;
}

landfall_status keep(landfall_status status, const char* function, const char* message) noexcept {
  try {
    last_error = std::string(function) + ": " + message;
  } catch (...) {
    last_error.clear();
  }
  return status;
}

}  // namespace

landfall_status keep_current_exception(const char* function) noexcept {
  try {
    throw;
  } catch (const Error& error) {
    return keep(to_c(error.code()), function, error.what());
  } catch (const std::bad_alloc&) {
    return keep(LANDFALL_OUT_OF_MEMORY, function, "out of memory");
  } catch (const std::exception& error) {
    return keep(LANDFALL_INTERNAL, function, error.what());
  } catch (...) {
    return keep(LANDFALL_INTERNAL, function, "an exception of unknown type");
  }
}

}  // namespace landfall::c

const char* landfall_last_error(void) {
  return landfall::c::last_error.c_str();
}

const char* landfall_version(void) {
  return LANDFALL_VERSION;
}
