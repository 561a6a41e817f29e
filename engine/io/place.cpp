#include "engine/io/place.hpp"

#include "engine/io/text.hpp"

namespace landfall::io {

std::string to_string(const Place& place) {
  return place.line > 0 ? place.file + ":" + std::to_string(place.line) : place.file;
}

std::string shown(std::string_view value) {
  constexpr std::size_t max_characters = 40;
  std::string text = "'";
  for (const char c : value.substr(0, max_characters)) {
    const bool printable = static_cast<unsigned char>(c) >= 0x20 && static_cast<unsigned char>(c) < 0x7f;
    text += printable ? c : '?';
  }
  return text + (value.size() > max_characters ? "...'" : "'");
}

std::string shown(double value) {
  std::string text;
  append_number(text, value);
  return text;
}

void fail_format(const Place& place, std::string_view field, const std::string& found,
                 std::string_view expected, ErrorCode code) {
  std::string message = to_string(place) + ": ";
  if (!field.empty()) message.append(field).append(": ");
  throw Error(code, message + "found " + found + ", expected " + std::string(expected));
}

}  // namespace landfall::io
