#include "raycast/grid_walk.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace landfall::raycast {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// First length at which a coordinate leaves its cell; +inf where it never does.
double first_crossing(double at, double direction) {
  if (direction > 0.0) return (std::floor(at) + 1.0 - at) / direction;
  if (direction < 0.0) return (std::floor(at) - at) / direction;
  return infinity;
}

// Lengths at which a ray enters and leaves 0 <= coordinate <= size.
std::pair<double, double> slab(double at, double direction, double size) {
  if (direction == 0.0)
    return at >= 0.0 && at < size ? std::pair{-infinity, infinity} : std::pair{infinity, -infinity};
  const double a = -at / direction;
  const double b = (size - at) / direction;
  return {std::min(a, b), std::max(a, b)};
}

}  // namespace

CellWalk::CellWalk(double x, double y, double dx, double dy)
    : col_(static_cast<int>(std::floor(x))),
      row_(static_cast<int>(std::floor(y))),
      step_col_(dx > 0.0 ? 1 : -1),
      step_row_(dy > 0.0 ? 1 : -1),
      next_x_(first_crossing(x, dx)),
      next_y_(first_crossing(y, dy)),
      per_col_(dx == 0.0 ? infinity : std::abs(1.0 / dx)),
      per_row_(dy == 0.0 ? infinity : std::abs(1.0 / dy)) {}

double walk_grid(const Grid& grid, double x, double y, double dx, double dy, double range_max) {
  const auto [enter_x, leave_x] = slab(x, dx, grid.width_cells);
  const auto [enter_y, leave_y] = slab(y, dy, grid.height_cells);
  // One cell short of the grid, so that rounding cannot start the walk beyond its first cells.
  const double skipped = std::max(0.0, std::max(enter_x, enter_y) - 1.0);
  const double last = std::min({range_max, leave_x, leave_y});
  if (!(skipped <= last)) return infinity;
  CellWalk walk(x + skipped * dx, y + skipped * dy, dx, dy);
  for (; skipped + walk.entered() <= last; walk.step()) {
    const int col = walk.col();
    const int row = walk.row();
    if (col < 0 || col >= grid.width_cells || row < 0 || row >= grid.height_cells) continue;
    const auto width = static_cast<std::size_t>(grid.width_cells);
    const std::size_t index = static_cast<std::size_t>(row) * width + static_cast<std::size_t>(col);
    if (grid.cells[index] == grid.occupied) return skipped + walk.entered();
  }
  return infinity;
}

}  // namespace landfall::raycast
