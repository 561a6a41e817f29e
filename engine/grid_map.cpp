#include "landfall/grid_map.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "engine/number_text.hpp"
#include "landfall/error.hpp"

namespace landfall {
namespace {

// Far outside of any grid stays outside, and so does what is no number.
int whole_cells(double cells) {
  constexpr double farthest = 1 << 30;
  return static_cast<int>(std::floor(std::max(-farthest, std::min(farthest, cells))));
}

}  // namespace

CellIndex GridMap::cell_of(const Point2& p_map) const {
  const Point2 p_grid = inverse(T_map_grid) * p_map;
  return {whole_cells(p_grid.x_m / resolution_m), whole_cells(p_grid.y_m / resolution_m)};
}

Point2 GridMap::center_of(CellIndex cell) const {
  return T_map_grid * Point2{(cell.col + 0.5) * resolution_m, (cell.row + 0.5) * resolution_m};
}

void validate(const GridMap& map) {
  const auto fail = [](ErrorCode code, const std::string& message) {
    throw Error(code, "grid map: " + message);
  };
  if (map.width_cells <= 0 || map.height_cells <= 0)
    fail(ErrorCode::invalid_argument, "size is " + std::to_string(map.width_cells) + " x " +
                                          std::to_string(map.height_cells) +
                                          " cells, expected at least 1 x 1");
  if (std::max(map.width_cells, map.height_cells) > max_map_side_cells)
    fail(ErrorCode::too_large, "size is " + std::to_string(map.width_cells) + " x " +
                                   std::to_string(map.height_cells) + " cells, at most " +
                                   std::to_string(max_map_side_cells) + " a side are taken");
  const std::int64_t cells = std::int64_t{map.width_cells} * map.height_cells;
  if (cells > max_map_cells)
    fail(ErrorCode::too_large, "size is " + std::to_string(cells) + " cells, at most " +
                                   std::to_string(max_map_cells) + " are taken");
  if (!(map.resolution_m > 0.0) || !std::isfinite(map.resolution_m))
    fail(ErrorCode::invalid_argument,
         "resolution_m is " + number_text(map.resolution_m) + ", expected a positive number");
  if (!is_finite(map.T_map_grid)) fail(ErrorCode::invalid_argument, "origin is not finite");
  if (map.cells.size() != static_cast<std::size_t>(cells))
    fail(ErrorCode::invalid_argument,
         "holds " + std::to_string(map.cells.size()) + " cells, expected " + std::to_string(cells));
}

}  // namespace landfall
