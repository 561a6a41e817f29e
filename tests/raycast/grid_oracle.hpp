// Ranges by the exact grid walk, in the map frame: what every other ray caster is held against.
#pragma once

#include <cmath>
#include <cstdint>
#include <span>

#include "landfall/grid_map.hpp"
#include "raycast/grid_walk.hpp"

namespace landfall::testing {

inline raycast::Grid grid_view(const GridMap& map) {
  return {.cells = {reinterpret_cast<const std::uint8_t*>(map.cells.data()), map.cells.size()},
          .width_cells = map.width_cells,
          .height_cells = map.height_cells,
          .occupied = static_cast<std::uint8_t>(Occupancy::occupied)};
}

// The beam is shifted to its left by shift_m first.
inline double walked_range_m(const GridMap& map, const Pose2& T_map_beam, double range_max_m,
                             double shift_m = 0.0) {
  const Pose2 T_grid_beam =
      inverse(map.T_map_grid) * T_map_beam * Pose2{.x_m = 0.0, .y_m = shift_m, .theta_rad = 0.0};
  return map.resolution_m *
         raycast::walk_grid(grid_view(map), T_grid_beam.x_m / map.resolution_m,
                            T_grid_beam.y_m / map.resolution_m, std::cos(T_grid_beam.theta_rad),
                            std::sin(T_grid_beam.theta_rad), range_max_m / map.resolution_m);
}

}  // namespace landfall::testing
