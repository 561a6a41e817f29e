#include "engine/io/carmen_line.hpp"

#include <cmath>
#include <limits>

namespace landfall::io {

std::string CarmenLine::path(std::string_view field) const {
  return std::string(kind_) + " " + std::string(field);
}

int CarmenLine::numbers_ahead(Words words) {
  int count = 0;
  while (parse_number(words.next())) ++count;
  return count;
}

// A lost reading shifts all that follows, and the first oddity is then seen elsewhere: so whether the
// line holds as many numbers as it promises is asked first. They end at the host's name, which is the
// last word but one, or at the line's end.
void CarmenLine::check_amount() const {
  if (numbers_after_ranges_ < 0) return;
  const int expected = ranges_ + numbers_after_ranges_;
  const int found = numbers_ahead(from_ranges_);
  Words words = from_ranges_;
  for (int i = 0; i < found; ++i) words.next();
  words.next();
  words.next();
  const bool ends_at_host = words.next().empty();
  if (ends_at_host && found != expected)
    fail_format(place_, path("readings"), std::to_string(found) + " numbers",
                std::to_string(expected) + ": " + std::to_string(ranges_) + " ranges and " +
                    std::to_string(numbers_after_ranges_) + " more");
}

void CarmenLine::fail(std::string_view field, std::string_view word, std::string_view expected) const {
  check_amount();
  fail_format(place_, path(field), word.empty() ? "the end of the line" : shown(word), expected);
}

double CarmenLine::number(std::string_view field) {
  const std::string_view word = words_.next();
  const std::optional<double> value = parse_number(word);
  if (!value || !std::isfinite(*value)) fail(field, word, "a finite number");
  return *value;
}

int CarmenLine::count(std::string_view field) {
  const std::string_view word = words_.next();
  const std::optional<long long> value = parse_integer(word);
  if (!value || *value < 0 || *value > std::numeric_limits<int>::max())
    fail(field, word, "a whole number >= 0");
  return static_cast<int>(*value);
}

Pose2 CarmenLine::pose(std::string_view field) {
  const double x_m = number(field);
  const double y_m = number(field);
  const double theta_rad = number(field);
  return {.x_m = x_m, .y_m = y_m, .theta_rad = wrap_angle(theta_rad)};
}

std::vector<float> CarmenLine::ranges(int count, int numbers_after) {
  from_ranges_ = words_;
  ranges_ = count;
  numbers_after_ranges_ = numbers_after;
  // Each takes a digit and a blank: no memory for readings that cannot be there.
  if (static_cast<std::size_t>(count) > words_.rest().size() / 2 + 1) {
    check_amount();
    fail_format(place_, path("number of readings"), std::to_string(count),
                "at most " + std::to_string(numbers_ahead(words_)) + ", as the line holds");
  }
  std::vector<float> ranges_m;
  ranges_m.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) {
    const std::string_view word = words_.next();
    const std::optional<double> value = parse_number(word);
    if (!value || !(*value >= 0.0)) fail("range " + std::to_string(i), word, "a number >= 0");
    ranges_m.push_back(static_cast<float>(*value));
  }
  return ranges_m;
}

double CarmenLine::stamp_s() {
  const double stamp_s = number("timestamp");
  const std::string_view host = words_.next();
  if (parse_number(host)) fail("host", host, "a name behind the time stamp");
  return stamp_s;
}

void CarmenLine::skip(int numbers, std::string_view field) {
  for (int i = 0; i < numbers; ++i) number(field);
}

}  // namespace landfall::io
