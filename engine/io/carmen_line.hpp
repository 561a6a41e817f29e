// The numbers of a CARMEN message, field by field.
#pragma once

#include <string_view>
#include <vector>

#include "engine/io/place.hpp"
#include "engine/io/text.hpp"
#include "landfall/pose2.hpp"

namespace landfall::io {

class CarmenLine {
 public:
  CarmenLine(std::string_view kind, Words words, const Place& place)
      : kind_(kind), words_(words), place_(place) {}

  double number(std::string_view field);  // finite
  int count(std::string_view field);      // a whole number >= 0
  Pose2 pose(std::string_view field);     // x y theta
  // `count` readings; `numbers_after` numbers are to follow before the host's name (-1: it depends).
  std::vector<float> ranges(int count, int numbers_after);
  // The message's time stamp; behind it come a host's name and the logger's own stamp, or nothing.
  double stamp_s();
  void skip(int numbers, std::string_view field);

  // The word that comes next.
  [[nodiscard]] std::string_view peek() const { return Words(words_).next(); }
  [[nodiscard]] Words rest() const { return words_; }
  [[nodiscard]] const Place& place() const { return place_; }

 private:
  static int numbers_ahead(Words words);
  [[nodiscard]] std::string path(std::string_view field) const;
  void check_amount() const;
  [[noreturn]] void fail(std::string_view field, std::string_view word, std::string_view expected) const;

  std::string_view kind_;
  Words words_;
  Place place_;
  Words from_ranges_{""};
  int ranges_ = 0;
  int numbers_after_ranges_ = -1;
};

}  // namespace landfall::io
