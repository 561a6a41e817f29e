// Lines, words and numbers of text files; locale-free.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace landfall::io {

// The whole of `text` as a number ("1", "-2.5e3", "+7"; "nan" and "inf" too), or nothing.
std::optional<double> parse_number(std::string_view text);
std::optional<long long> parse_integer(std::string_view text);
// The shortest text that reads back as the same number.
void append_number(std::string& out, double value);
void append_number(std::string& out, float value);

// A text line by line, without the line ends ("\n" or "\r\n").
class Lines {
 public:
  explicit Lines(std::string_view text) : rest_(text) {}
  bool next(std::string_view& line);
  [[nodiscard]] int number() const { return number_; }  // of the last line, counted from 1

 private:
  std::string_view rest_;
  int number_ = 0;
};

// A line word by word; words end at blanks.
class Words {
 public:
  explicit Words(std::string_view line) : rest_(line) {}
  // Empty at the line's end.
  std::string_view next();
  [[nodiscard]] std::string_view rest() const { return rest_; }

 private:
  std::string_view rest_;
};

}  // namespace landfall::io
