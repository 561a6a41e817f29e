// Rays through a grid of cells, cell by cell (Amanatides & Woo 1987, A Fast Voxel Traversal Algorithm for
// Ray Tracing): exact, and the oracle of every faster way. Lengths in cells; cell (col, row) covers
// [col, col + 1) x [row, row + 1).
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

namespace landfall::raycast {

// The cells that a ray passes, in order, over an endless grid. Where it passes exactly through a corner
// it steps in y first.
class CellWalk {
 public:
  CellWalk(double x, double y, double dx, double dy);

  [[nodiscard]] int col() const { return col_; }
  [[nodiscard]] int row() const { return row_; }
  // Length along the ray (in units of its direction) at which it entered the present cell, or leaves it.
  [[nodiscard]] double entered() const { return entered_; }
  [[nodiscard]] double leaves() const { return next_x_ < next_y_ ? next_x_ : next_y_; }

  void step() {
    if (next_x_ < next_y_) {
      entered_ = next_x_;
      next_x_ += per_col_;
      col_ += step_col_;
    } else {
      entered_ = next_y_;
      next_y_ += per_row_;
      row_ += step_row_;
    }
  }

 private:
  int col_, row_;
  int step_col_, step_row_;
  double entered_ = 0.0;
  double next_x_, next_y_;    // where the ray meets the next column, the next row
  double per_col_, per_row_;  // from one column to the next, one row to the next
};

struct Grid {
  std::span<const std::uint8_t> cells;  // row by row
  int width_cells = 0;
  int height_cells = 0;
  std::uint8_t occupied = 1;  // cells of this value stop a ray
};

// Length in cells from (x, y) to the face where the ray of unit direction (dx, dy) enters an occupied
// cell: 0 where it starts in one, +inf where it meets none within range_max. Nothing is outside the grid.
double walk_grid(const Grid& grid, double x, double y, double dx, double dy, double range_max);

}  // namespace landfall::raycast
