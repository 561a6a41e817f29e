// The poses that searches score: centres of the grid's cells x equally spaced headings.
#pragma once

#include <cstdint>

#include "landfall/grid_map.hpp"

namespace landfall::internal {

struct LatticePose {
  std::int32_t heading = 0;
  std::int32_t row = 0;
  std::int32_t col = 0;
  friend auto operator<=>(const LatticePose&, const LatticePose&) = default;  // the order of ties
};

// Headings are counted in the grid's own frame, so that turning map and scan together changes nothing:
// first_heading_rad + k 2 pi / N. The first is 0 but for methods that centre headings on the prior.
struct Lattice {
  double resolution_m = 0.0;
  Pose2 T_map_grid;
  int width_cells = 0;
  int height_cells = 0;
  int headings = 0;    // N
  int step_cells = 1;  // every step_cells-th column and row, from 0
  double first_heading_rad = 0.0;

  [[nodiscard]] double heading_step_rad() const;
  // The heading of index k in the grid's frame, in (-pi, pi].
  [[nodiscard]] double heading_grid_rad(int heading) const;
  [[nodiscard]] Pose2 T_map_robot(const LatticePose& pose) const;
  [[nodiscard]] bool contains(const LatticePose& pose) const {
    return pose.col >= 0 && pose.col < width_cells && pose.row >= 0 && pose.row < height_cells;
  }
  // The lattice pose nearest to a pose; it may lie outside the grid.
  [[nodiscard]] LatticePose nearest(const Pose2& T_map_robot) const;
};

// Throws Error{invalid_argument}: a translation step that is no multiple of the resolution, a rotation
// step that is not positive or gives more than 36,000 headings.
Lattice make_lattice(const GridMap& map, double translation_step_m, double rotation_step_rad);

}  // namespace landfall::internal
