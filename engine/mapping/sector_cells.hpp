// The cells whose centres lie within a sonar's cone.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "engine/mapping/tbf/arc.hpp"
#include "landfall/grid_map.hpp"

namespace landfall::internal {

// visit(index, distance_m, cos_off): every cell of the grid (its axes are the map's) whose centre is at most
// range_m from the arc's centre, and off its axis by an angle with a cosine of at least cos_most.
template <class Visit>
void visit_sector(const GridMap& grid, const Arc& arc, double range_m, double cos_most, const Visit& visit) {
  if (!(range_m > 0.0)) return;
  const double sin_most = std::sqrt(std::max(0.0, 1.0 - cos_most * cos_most));
  Point2 low = arc.center_map;
  Point2 high = arc.center_map;
  const auto add = [&](double x, double y) {
    low = {.x_m = std::min(low.x_m, arc.center_map.x_m + x),
           .y_m = std::min(low.y_m, arc.center_map.y_m + y)};
    high = {.x_m = std::max(high.x_m, arc.center_map.x_m + x),
            .y_m = std::max(high.y_m, arc.center_map.y_m + y)};
  };
  for (const double side : {sin_most, -sin_most})
    add(range_m * (cos_most * arc.axis_x - side * arc.axis_y),
        range_m * (cos_most * arc.axis_y + side * arc.axis_x));
  // Where the arc reaches farther along an axis of the map than its ends do.
  for (const double sign : {1.0, -1.0}) {
    if (sign * arc.axis_x >= cos_most) add(sign * range_m, 0.0);
    if (sign * arc.axis_y >= cos_most) add(0.0, sign * range_m);
  }
  const CellIndex first = grid.cell_of(low);
  const CellIndex last = grid.cell_of(high);
  for (int row = std::max(0, first.row); row <= std::min(last.row, grid.height_cells - 1); ++row)
    for (int col = std::max(0, first.col); col <= std::min(last.col, grid.width_cells - 1); ++col) {
      const double x = grid.T_map_grid.x_m + (col + 0.5) * grid.resolution_m - arc.center_map.x_m;
      const double y = grid.T_map_grid.y_m + (row + 0.5) * grid.resolution_m - arc.center_map.y_m;
      const double squared = x * x + y * y;
      if (squared > range_m * range_m) continue;
      const double distance_m = std::sqrt(squared);
      const double forward_m = x * arc.axis_x + y * arc.axis_y;
      if (forward_m < distance_m * cos_most) continue;
      visit(grid.index({.col = col, .row = row}), distance_m,
            distance_m > 0.0 ? forward_m / distance_m : 1.0);
    }
}

}  // namespace landfall::internal
