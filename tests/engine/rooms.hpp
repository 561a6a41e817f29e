// Rooms of cells, and scans without noise in them.
#pragma once

#include <memory>
#include <numbers>
#include <vector>

#include "landfall/prepared_map.hpp"
#include "landfall/simulate.hpp"

namespace landfall::testing {

// Cells [from, to], both included.
inline void fill(GridMap& map, CellIndex from, CellIndex to, Occupancy what) {
  for (int row = from.row; row <= to.row; ++row)
    for (int col = from.col; col <= to.col; ++col) map.cells[map.index({col, row})] = what;
}

inline GridMap empty_map(int width_cells, int height_cells, double resolution_m,
                         const Pose2& T_map_grid = {}) {
  GridMap map{.width_cells = width_cells,
              .height_cells = height_cells,
              .resolution_m = resolution_m,
              .T_map_grid = T_map_grid,
              .cells = {}};
  map.cells.assign(static_cast<std::size_t>(width_cells) * static_cast<std::size_t>(height_cells),
                   Occupancy::free);
  return map;
}

// Walls of one cell's thickness around the cells [from, to].
inline void draw_walls(GridMap& map, CellIndex from, CellIndex to) {
  fill(map, from, {to.col, from.row}, Occupancy::occupied);
  fill(map, {from.col, to.row}, to, Occupancy::occupied);
  fill(map, from, {from.col, to.row}, Occupancy::occupied);
  fill(map, {to.col, from.row}, to, Occupancy::occupied);
}

inline GridMap empty_room(int width_cells, int height_cells, double resolution_m,
                          const Pose2& T_map_grid = {}) {
  GridMap map = empty_map(width_cells, height_cells, resolution_m, T_map_grid);
  draw_walls(map, {0, 0}, {width_cells - 1, height_cells - 1});
  return map;
}

// 8 m x 6 m in cells of 10 cm, with a cupboard and a pillar: no two places look the same.
inline GridMap furnished_room(const Pose2& T_map_grid = {}) {
  GridMap map = empty_room(80, 60, 0.1, T_map_grid);
  fill(map, {10, 45}, {30, 50}, Occupancy::occupied);
  fill(map, {60, 20}, {63, 23}, Occupancy::occupied);
  return map;
}

inline std::shared_ptr<const Sensor> full_circle(int beams, double range_max_m = 30.0) {
  return std::make_shared<const Sensor>(make_fan({.beams = beams,
                                                  .first_rad = -std::numbers::pi,
                                                  .step_rad = 2.0 * std::numbers::pi / beams,
                                                  .range_max_m = range_max_m}));
}

inline Scan look(const PreparedMap& map, const std::shared_ptr<const Sensor>& sensor,
                 const Pose2& T_map_robot) {
  return simulate(map, sensor, std::vector<Pose2>{T_map_robot}, {.noise = false}).front();
}

}  // namespace landfall::testing
