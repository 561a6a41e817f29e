// Walls become the cells they touch.
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "engine/maps/grid_extent.hpp"
#include "landfall/wall_map.hpp"

namespace landfall {
namespace {

// Row by row: the columns between where the wall enters the row and where it leaves it. Neighbouring
// rows share the column where the wall passes from one to the other, so no ray slips between corners.
void draw(GridMap& grid, const Wall& wall) {
  const auto to_cells = [&](const Point2& p_map) {
    return Point2{.x_m = (p_map.x_m - grid.T_map_grid.x_m) / grid.resolution_m,
                  .y_m = (p_map.y_m - grid.T_map_grid.y_m) / grid.resolution_m};
  };
  Point2 low = to_cells(wall.a_map);
  Point2 high = to_cells(wall.b_map);
  if (low.y_m > high.y_m) std::swap(low, high);
  const auto clamp_col = [&](double x) {
    return std::clamp(static_cast<int>(std::floor(x)), 0, grid.width_cells - 1);
  };
  const int last_row = std::min(static_cast<int>(std::floor(high.y_m)), grid.height_cells - 1);
  const double cols_per_row = high.y_m > low.y_m ? (high.x_m - low.x_m) / (high.y_m - low.y_m) : 0.0;
  for (int row = std::max(static_cast<int>(std::floor(low.y_m)), 0); row <= last_row; ++row) {
    const double enter_x = row <= low.y_m ? low.x_m : low.x_m + (row - low.y_m) * cols_per_row;
    const double leave_x = row + 1 >= high.y_m ? high.x_m : low.x_m + (row + 1 - low.y_m) * cols_per_row;
    const int first_col = clamp_col(std::min(enter_x, leave_x));
    const int last_col = clamp_col(std::max(enter_x, leave_x));
    for (int col = first_col; col <= last_col; ++col)
      grid.cells[grid.index({.col = col, .row = row})] = Occupancy::occupied;
  }
}

// Floods the free cells that the border reaches through shared edges.
void mark_outside(GridMap& grid) {
  std::vector<CellIndex> front;
  const auto visit = [&](int col, int row) {
    const CellIndex cell{.col = col, .row = row};
    if (grid.at(cell) != Occupancy::free) return;  // beyond the grid: unknown
    grid.cells[grid.index(cell)] = Occupancy::unknown;
    front.push_back(cell);
  };
  for (int col = 0; col < grid.width_cells; ++col) {
    visit(col, 0);
    visit(col, grid.height_cells - 1);
  }
  for (int row = 0; row < grid.height_cells; ++row) {
    visit(0, row);
    visit(grid.width_cells - 1, row);
  }
  while (!front.empty()) {
    const CellIndex cell = front.back();
    front.pop_back();
    visit(cell.col - 1, cell.row);
    visit(cell.col + 1, cell.row);
    visit(cell.col, cell.row - 1);
    visit(cell.col, cell.row + 1);
  }
}

}  // namespace

GridMap to_grid(const WallMap& map, const GridFromWallsOptions& options) {
  validate(map);
  internal::Extent extent;
  for (const Wall& wall : map.walls) {
    extent.add(wall.a_map);
    extent.add(wall.b_map);
  }
  GridMap grid = internal::make_grid(extent, {.resolution_m = options.resolution_m,
                                              .margin_m = options.margin_m,
                                              .fill = Occupancy::free,
                                              .what = "grid from walls"});
  for (const Wall& wall : map.walls) draw(grid, wall);
  if (options.outside_unknown) mark_outside(grid);
  return grid;
}

}  // namespace landfall
