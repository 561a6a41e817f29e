#include "engine/priors/lattice.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "engine/base/number_text.hpp"
#include "landfall/error.hpp"

namespace landfall::internal {
namespace {

constexpr double full_turn_rad = 2.0 * std::numbers::pi;
constexpr int max_headings = 36'000;

// Far outside of any grid stays outside.
int nearest_multiple(double value, int step) {
  constexpr double farthest = 1 << 28;
  return static_cast<int>(std::lround(std::clamp(value, -farthest, farthest) / step)) * step;
}

}  // namespace

double Lattice::heading_step_rad() const {
  return full_turn_rad / headings;
}

double Lattice::heading_grid_rad(int heading) const {
  return wrap_angle(first_heading_rad + heading * full_turn_rad / headings);
}

Pose2 Lattice::T_map_robot(const LatticePose& pose) const {
  return T_map_grid * Pose2{(pose.col + 0.5) * resolution_m, (pose.row + 0.5) * resolution_m,
                            heading_grid_rad(pose.heading)};
}

LatticePose Lattice::nearest(const Pose2& T_map_robot) const {
  const Pose2 T_grid_robot = inverse(T_map_grid) * T_map_robot;
  const auto heading =
      static_cast<int>(std::lround((T_grid_robot.theta_rad - first_heading_rad) / heading_step_rad()));
  return {.heading = (heading % headings + headings) % headings,
          .row = nearest_multiple(T_grid_robot.y_m / resolution_m - 0.5, step_cells),
          .col = nearest_multiple(T_grid_robot.x_m / resolution_m - 0.5, step_cells)};
}

Lattice make_lattice(const GridMap& map, double translation_step_m, double rotation_step_rad) {
  const double step_cells = translation_step_m == 0.0 ? 1.0 : translation_step_m / map.resolution_m;
  if (!(step_cells > 0.5) || step_cells > max_map_side_cells ||
      std::abs(step_cells - std::round(step_cells)) > 1e-6 * step_cells) {
    throw Error(ErrorCode::invalid_argument,
                "option translation_step_m is " + number_text(translation_step_m) +
                    ", expected 0 or a multiple of the map's resolution, " + number_text(map.resolution_m));
  }
  if (!(rotation_step_rad >= full_turn_rad / max_headings) || !(rotation_step_rad <= full_turn_rad)) {
    throw Error(ErrorCode::invalid_argument, "option rotation_step_rad is " + number_text(rotation_step_rad) +
                                                 ", expected " + number_text(full_turn_rad / max_headings) +
                                                 " to " + number_text(full_turn_rad));
  }
  // A step of 2 pi / N as written by a caller may come out a hair below it: that is N, not N + 1.
  const double turns = full_turn_rad / rotation_step_rad;
  return {.resolution_m = map.resolution_m,
          .T_map_grid = map.T_map_grid,
          .width_cells = map.width_cells,
          .height_cells = map.height_cells,
          .headings = static_cast<int>(std::ceil(turns * (1.0 - 1e-12))),
          .step_cells = static_cast<int>(std::lround(step_cells))};
}

}  // namespace landfall::internal
