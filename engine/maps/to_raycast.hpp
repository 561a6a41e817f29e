// The engine's nouns as the raycaster's plain values.
#pragma once

#include <vector>

#include "landfall/grid_map.hpp"
#include "landfall/sensor.hpp"
#include "landfall/wall_map.hpp"
#include "raycast/values.hpp"

namespace landfall::internal {

inline raycast::Pose to_raycast(const Pose2& pose) {
  return {.x_m = pose.x_m, .y_m = pose.y_m, .theta_rad = pose.theta_rad};
}

inline std::vector<raycast::Beam> to_raycast(const Sensor& sensor) {
  std::vector<raycast::Beam> beams;
  beams.reserve(sensor.beams.size());
  for (const Beam& beam : sensor.beams)
    beams.push_back({.x_m = beam.T_robot_beam.x_m,
                     .y_m = beam.T_robot_beam.y_m,
                     .theta_rad = beam.T_robot_beam.theta_rad,
                     .half_angle_rad = beam.half_angle_rad,
                     .range_max_m = beam.range_max_m});
  return beams;
}

inline std::vector<raycast::Segment> to_raycast(const WallMap& map) {
  std::vector<raycast::Segment> segments;
  segments.reserve(map.walls.size());
  for (const Wall& wall : map.walls)
    segments.push_back(
        {.ax_m = wall.a_map.x_m, .ay_m = wall.a_map.y_m, .bx_m = wall.b_map.x_m, .by_m = wall.b_map.y_m});
  return segments;
}

inline raycast::PlacedGrid to_raycast(const GridMap& map) {
  return {.grid = {.cells = {reinterpret_cast<const std::uint8_t*>(map.cells.data()), map.cells.size()},
                   .width_cells = map.width_cells,
                   .height_cells = map.height_cells,
                   .occupied = static_cast<std::uint8_t>(Occupancy::occupied)},
          .resolution_m = map.resolution_m,
          .T_frame_grid = to_raycast(map.T_map_grid)};
}

}  // namespace landfall::internal
