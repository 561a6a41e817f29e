// Rays through a grid, from one free square to the next.
//
// Each cell knows the largest square without obstacle that has the cell at a corner and lies where the ray
// goes; the ray leaves it in one step. Beside a wall the squares are single cells, so the face where a ray
// ends is that of the walk from cell to cell, however large the steps before.
#pragma once

#include <cstddef>
#include <cstdint>

namespace landfall::kernels {

inline constexpr std::size_t march_multiple = 16;  // rays come in multiples of this

// Sides of squares in cells, for squares towards (+, +), (-, +), (+, -) and (-, -) of (column, row): four
// grids one after the other, row by row. The grid has a ring of `beyond_grid` around it, which no square
// reaches into: rays end there.
struct FreeSquares {
  static constexpr std::uint8_t obstacle = 0;
  static constexpr std::uint8_t largest = 254;
  static constexpr std::uint8_t beyond_grid = 255;

  const std::uint32_t* sides = nullptr;  // four cells a word, the first in its lowest byte
  std::int32_t width_cells = 0;          // the ring included
  std::int32_t height_cells = 0;         // 4 width_cells height_cells < 2^31
};

// Arrays, a ray each; lengths in cells.
struct Marches {
  const std::int32_t* start_cell;  // row by row, the ring included
  const float* x;                  // within the start cell, in [0, 1)
  const float* y;
  const float* dx;  // unit direction
  const float* dy;
  const float* range_max;  // less than 0: the ray is not cast
};

// range[i]: the length at which ray i enters an obstacle, 0 where it starts in one; +inf: none within
// range_max[i]. Exactly through a corner it steps in y first. `rays` is a multiple of march_multiple. Equal
// over instruction sets, bit for bit.
void march_rays(const FreeSquares& squares, const Marches& marches, std::size_t rays, float* range);

namespace scalar {
void march_rays(const FreeSquares& squares, const Marches& marches, std::size_t rays, float* range);
}

}  // namespace landfall::kernels
