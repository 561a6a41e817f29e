#include "landfall/grid_map.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "engine/base/number_text.hpp"
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

namespace {
// Farther out the numbers of a pose are coarser than a thousandth of a cell.
constexpr double farthest_origin_cells = 8e12;
constexpr double finest_m = 1e-6;
constexpr double coarsest_m = 1e6;
}  // namespace

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
  if (!(map.resolution_m >= finest_m && map.resolution_m <= coarsest_m))
    fail(ErrorCode::invalid_argument, "resolution_m is " + number_text(map.resolution_m) + ", expected " +
                                          number_text(finest_m) + " to " + number_text(coarsest_m));
  const double farthest_m = farthest_origin_cells * map.resolution_m;
  if (!is_finite(map.T_map_grid) ||
      std::max(std::abs(map.T_map_grid.x_m), std::abs(map.T_map_grid.y_m)) > farthest_m)
    fail(ErrorCode::invalid_argument, "origin is " + pose_text(map.T_map_grid) + ", expected within " +
                                          number_text(farthest_m) + " m, where cells can be told apart");
  if (map.cells.size() != static_cast<std::size_t>(cells))
    fail(ErrorCode::invalid_argument,
         "holds " + std::to_string(map.cells.size()) + " cells, expected " + std::to_string(cells));
}

}  // namespace landfall
