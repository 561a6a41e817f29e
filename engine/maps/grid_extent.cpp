#include "engine/maps/grid_extent.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "engine/base/number_text.hpp"
#include "landfall/error.hpp"

namespace landfall::internal {

void Extent::add(const Point2& p_map) {
  low = {.x_m = std::min(low.x_m, p_map.x_m), .y_m = std::min(low.y_m, p_map.y_m)};
  high = {.x_m = std::max(high.x_m, p_map.x_m), .y_m = std::max(high.y_m, p_map.y_m)};
}

GridMap make_grid(const Extent& extent, const ExtentGridOptions& options) {
  const double resolution_m = options.resolution_m;
  if (!(resolution_m > 0.0) || !std::isfinite(resolution_m))
    throw Error(ErrorCode::invalid_argument, options.what + ": resolution_m is " + number_text(resolution_m) +
                                                 ", expected a positive number");
  if (!(options.margin_m >= 0.0) || !std::isfinite(options.margin_m))
    throw Error(ErrorCode::invalid_argument, options.what + ": margin_m is " + number_text(options.margin_m) +
                                                 ", expected a finite number >= 0");
  const auto cell_of = [&](double p_m) { return std::floor(p_m / resolution_m); };
  const double first_col = cell_of(extent.low.x_m - options.margin_m);
  const double first_row = cell_of(extent.low.y_m - options.margin_m);
  const double width = cell_of(extent.high.x_m + options.margin_m) - first_col + 1.0;
  const double height = cell_of(extent.high.y_m + options.margin_m) - first_row + 1.0;
  if (!(width * height <= static_cast<double>(max_map_cells)) || std::max(width, height) > max_map_side_cells)
    throw Error(ErrorCode::too_large, options.what + ": " + number_text(width) + " x " + number_text(height) +
                                          " cells are needed, at most " + std::to_string(max_map_cells) +
                                          " and " + std::to_string(max_map_side_cells) + " a side are taken");
  const auto cells = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  return {.width_cells = static_cast<int>(width),
          .height_cells = static_cast<int>(height),
          .resolution_m = resolution_m,
          .T_map_grid = {.x_m = first_col * resolution_m, .y_m = first_row * resolution_m},
          .cells = std::vector<Occupancy>(cells, options.fill)};
}

}  // namespace landfall::internal
