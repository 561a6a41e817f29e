// Where end points fall while the heading turns through a group, in half blocks of a bound table.
#pragma once

#include <cstddef>
#include <cstdint>

namespace landfall::kernels {

// The heading turns by up to half_rad either way from the group's centre.
struct Turn {
  double cos_center = 1.0;
  double sin_center = 0.0;
  double sin_half = 0.0;  // 1 where half_rad is beyond a quarter turn: every direction is met
  double cos_half = 1.0;
};
// By so much windows are wider than they must be: far above double's error at a million cells.
inline constexpr double window_rounding = 1e-6;

struct WindowGrid {
  std::int32_t width_cells = 0;  // of the map
  std::int32_t height_cells = 0;
  std::int32_t block_cells = 0;  // a power of two
};

// For every point in cells, with poses anywhere in a block: the half block in which its window begins,
// relative to the block's own first one, and the window's size in half blocks (the wider of its sides). Size
// 0: off the map from every cell of it.
void point_windows(const double* x_cells, const double* y_cells, std::size_t points, const Turn& turn,
                   const WindowGrid& grid, std::int32_t* col_half, std::int32_t* row_half,
                   std::int32_t* size_halves);

namespace scalar {
void point_windows(const double* x_cells, const double* y_cells, std::size_t points, const Turn& turn,
                   const WindowGrid& grid, std::int32_t* col_half, std::int32_t* row_half,
                   std::int32_t* size_halves);
}

}  // namespace landfall::kernels
