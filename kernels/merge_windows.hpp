// Points of a heading group, as the bound kernel takes them: neighbours that share a window become one of a
// higher weight, and each weight's bits say which lists a point stands in.
#pragma once

#include <cstddef>
#include <cstdint>

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

// Structure of arrays, room for all points and `point_padding` more (bound_tile.hpp).
struct MergedWindows {
  std::int32_t* plane;
  std::int32_t* col;
  std::int32_t* row;
  std::int32_t* weight;
};

struct MergedCount {
  std::size_t windows = 0;
  std::int32_t unbounded = 0;  // points that no window is wide enough for
  std::int32_t weights = 0;    // all weights' bits
  std::int32_t least_col = 0, most_col = 0;
  std::int32_t least_row = 0, most_row = 0;
  friend bool operator==(const MergedCount&, const MergedCount&) = default;
};

// Points side by side whose windows (kernels::point_windows) are equal, in order; size 0 is left out.
// `run_begin` holds one element per point, and point_padding.
MergedCount merge_windows(const std::int32_t* col_half, const std::int32_t* row_half,
                          const std::int32_t* size_halves, std::size_t points, const WindowShelf& shelf,
                          std::int32_t* run_begin, const MergedWindows& merged);

// The list of those whose weight has the bit `bit`, and 4 * (plane + row * stride + col) of each. How many;
// up to point_padding elements beyond are overwritten.
std::size_t list_windows(const MergedWindows& merged, std::size_t windows, int bit, std::int32_t stride,
                         std::int32_t* plane, std::int32_t* col, std::int32_t* row, std::int32_t* first_byte);

namespace scalar {
MergedCount merge_windows(const std::int32_t* col_half, const std::int32_t* row_half,
                          const std::int32_t* size_halves, std::size_t points, const WindowShelf& shelf,
                          std::int32_t* run_begin, const MergedWindows& merged);
std::size_t list_windows(const MergedWindows& merged, std::size_t windows, int bit, std::int32_t stride,
                         std::int32_t* plane, std::int32_t* col, std::int32_t* row, std::int32_t* first_byte);
}  // namespace scalar

}  // namespace landfall::kernels
