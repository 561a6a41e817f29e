#include "engine/maps/wall_depth.hpp"

#include <cmath>

namespace landfall::internal {
namespace {

constexpr double deepest_m = 0.3;

bool has_open_cell_near(const GridMap& grid, const CellIndex& center) {
  const int reach = static_cast<int>(std::lround(deepest_m / grid.resolution_m));
  for (int row = center.row - reach; row <= center.row + reach; ++row)
    for (int col = center.col - reach; col <= center.col + reach; ++col)
      if (grid.at({.col = col, .row = row}) != Occupancy::occupied) return true;
  return false;
}

}  // namespace

bool ends_within_wall(const GridMap& grid, const Pose2& T_map_beam, double from_m, double to_m) {
  const double step_m = 0.5 * grid.resolution_m;
  const auto cell_at = [&](double range_m) {
    return grid.cell_of(T_map_beam * Point2{.x_m = range_m, .y_m = 0.0});
  };
  const int steps = static_cast<int>(std::floor((to_m - from_m) / step_m));
  for (int i = 1; i <= steps; ++i)
    if (grid.at(cell_at(from_m + i * step_m)) != Occupancy::occupied) return false;
  const CellIndex end = cell_at(to_m);
  return grid.at(end) == Occupancy::occupied && has_open_cell_near(grid, end);
}

}  // namespace landfall::internal
