// Points of a heading group, as the bound kernel takes them: neighbours that share a window become one of a
// higher weight, and each weight's bits say which lists a point stands in.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>

#include "kernels/bound_tile.hpp"

namespace landfall::kernels {

// Where a bound table keeps its windows.
struct WindowShelf {
  static constexpr std::int32_t sizes = 32;
  std::int32_t plane_of_size[sizes];  // first element of the plane for windows of so many halves (phase 0,
                                      // 0); negative: no window is so wide
  std::int32_t plane_size;  // odd columns' plane follows that of the even ones, odd rows' two planes
                            // those of the even ones
  std::int32_t stride;
  std::int32_t pad_cols;
  std::int32_t pad_rows;
};

// What BoundPoints lists, bit by bit of the windows' weights: the list of bit b is [begin[b], end[b]) of the
// arrays. A list has room for as many windows as can have so many points, and padding (bound_tile.hpp).
struct WindowLists {
  std::int32_t* plane;
  std::int32_t* col;
  std::int32_t* row;
  std::int32_t* first_byte;
  std::int32_t* begin;  // [list_count(points)], as is `end`
  std::int32_t* end;
};
// Lists that so many points may need, at least one, and elements of all of them.
constexpr int list_count(std::size_t points) {
  return std::max(1, static_cast<int>(std::bit_width(points)));
}
constexpr std::size_t lists_room(std::size_t points) {
  std::size_t room = 0;
  for (int bit = 0; bit < list_count(points); ++bit) room += (points >> bit) + point_padding;
  return room;
}
// Sets where lists begin, and empties them.
inline void begin_lists(std::size_t points, const WindowLists& lists) {
  std::int32_t at = 0;
  for (int bit = 0; bit < list_count(points); ++bit) {
    lists.begin[bit] = lists.end[bit] = at;
    at += static_cast<std::int32_t>((points >> bit) + point_padding);
  }
}

struct MergedCount {
  std::int32_t unbounded = 0;  // points that no window is wide enough for
  std::int32_t weights = 0;    // all weights' bits
  std::int32_t least_col = 0, most_col = 0;
  std::int32_t least_row = 0, most_row = 0;
  friend bool operator==(const MergedCount&, const MergedCount&) = default;
};

// Points side by side whose windows (kernels::point_windows) are equal are one of a weight, which stands in
// the list of every bit of it; size 0 is left out. `run_begin` holds one element per point, and
// point_padding.
MergedCount merge_windows(const std::int32_t* col_half, const std::int32_t* row_half,
                          const std::int32_t* size_halves, std::size_t points, const WindowShelf& shelf,
                          std::int32_t* run_begin, const WindowLists& lists);

namespace scalar {
MergedCount merge_windows(const std::int32_t* col_half, const std::int32_t* row_half,
                          const std::int32_t* size_halves, std::size_t points, const WindowShelf& shelf,
                          std::int32_t* run_begin, const WindowLists& lists);
}  // namespace scalar

}  // namespace landfall::kernels
