// For each cell of a grid, the largest squares without obstacle that have it at a corner: a distance field
// (Chebyshev's) for each of the four ways in which a ray may go.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "kernels/march_rays.hpp"
#include "raycast/grid_walk.hpp"

namespace landfall::raycast {

class FreeSquareTable {
 public:
  // Whether cells of such a grid, and of the ring around it, can be counted: four tables in 31 bits.
  static bool can_hold(int width_cells, int height_cells);
  // Of a grid that it can hold.
  explicit FreeSquareTable(const Grid& grid);

  [[nodiscard]] kernels::FreeSquares view() const {
    return {.sides = words_.data(), .width_cells = width_cells_, .height_cells = height_cells_};
  }
  // Index of a cell of the grid given, or of the ring around it, in the table.
  [[nodiscard]] std::int32_t index(int col, int row) const { return (row + 1) * width_cells_ + col + 1; }
  [[nodiscard]] bool is_obstacle(std::int32_t index) const {
    return (words_[static_cast<std::size_t>(index / 4)] >> (8 * (index % 4)) & 255u) ==
           kernels::FreeSquares::obstacle;
  }
  [[nodiscard]] std::size_t memory_bytes() const { return words_.capacity() * sizeof(std::uint32_t); }

 private:
  std::int32_t width_cells_, height_cells_;  // with the ring
  std::vector<std::uint32_t> words_;
};

}  // namespace landfall::raycast
