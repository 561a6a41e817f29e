#include "engine/mapping/tbf/ellipse_cells.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace landfall::internal {

void ellipse_cells(const GridMap& grid, const Point2& p_map, const Symmetric2& covariance_m2,
                   std::vector<CellDensity>& cells) {
  constexpr double sigmas = 3.0;
  cells.clear();
  const double cell_m2 = grid.resolution_m * grid.resolution_m / 12.0;
  const Symmetric2 wide{
      .xx = covariance_m2.xx + cell_m2, .xy = covariance_m2.xy, .yy = covariance_m2.yy + cell_m2};
  const Symmetric2 information = inverse(wide);
  const double peak = 1.0 / std::sqrt(2.0 * std::numbers::pi * wide.det());
  const double reach_x_m = sigmas * std::sqrt(wide.xx);
  const double reach_y_m = sigmas * std::sqrt(wide.yy);
  const CellIndex first = grid.cell_of({.x_m = p_map.x_m - reach_x_m, .y_m = p_map.y_m - reach_y_m});
  const CellIndex last = grid.cell_of({.x_m = p_map.x_m + reach_x_m, .y_m = p_map.y_m + reach_y_m});
  for (int row = std::max(0, first.row); row <= std::min(last.row, grid.height_cells - 1); ++row)
    for (int col = std::max(0, first.col); col <= std::min(last.col, grid.width_cells - 1); ++col) {
      const double x = grid.T_map_grid.x_m + (col + 0.5) * grid.resolution_m - p_map.x_m;
      const double y = grid.T_map_grid.y_m + (row + 0.5) * grid.resolution_m - p_map.y_m;
      const double squared = information.quadratic(x, y);
      if (squared <= sigmas * sigmas)
        cells.push_back(
            {.index = grid.index({.col = col, .row = row}), .density = peak * std::exp(-0.5 * squared)});
    }
}

}  // namespace landfall::internal
