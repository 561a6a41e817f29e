// Ivanjko, Petrovic & Miklic 2005, section 3; Ivanjko, Petrovic & Macek 2003, Improvements of Occupancy Grid
// Maps by Sonar Data Corrections. Not stated there and decided here: a side's sonars are those whose cone
// holds the perpendicular, because their range is then that of its foot; of two the farther counts.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <utility>

#include "landfall/sonar_mapping.hpp"

namespace landfall {
namespace {

constexpr double open_m = std::numeric_limits<double>::infinity();

// How far the box reaches from the robot's centre, in the robot's frame.
struct BoundingBox {
  double front_m = open_m;
  double back_m = open_m;
  double left_m = open_m;
  double right_m = open_m;
};

// The wall that the sonars facing `direction_rad` tell of: the farther of their echoes, open where one of
// them has none. Where they differ there is a corner or a door, and a box that is too small draws walls
// there.
double side_m(const Scan& scan, double direction_rad) {
  double farthest_m = -open_m;
  for (std::size_t b = 0; b < scan.ranges_m.size(); ++b) {
    const Beam& beam = scan.sensor->beams[b];
    const Pose2& mount = beam.T_robot_beam;
    if (angle_distance(mount.theta_rad, direction_rad) > beam.half_angle_rad) continue;
    if (classify(beam, scan.ranges_m[b]) != Reading::echo) return open_m;
    const double mount_m = mount.x_m * std::cos(direction_rad) + mount.y_m * std::sin(direction_rad);
    farthest_m = std::max(farthest_m, mount_m + scan.ranges_m[b]);
  }
  return farthest_m > -open_m ? farthest_m : open_m;
}

BoundingBox box_of(const Scan& scan) {
  constexpr double right_angle_rad = std::numbers::pi / 2;
  return {.front_m = side_m(scan, 0.0),
          .back_m = side_m(scan, std::numbers::pi),
          .left_m = side_m(scan, right_angle_rad),
          .right_m = side_m(scan, -right_angle_rad)};
}

// The range at which a beam's axis leaves the box; open where it meets no side, 0 where it starts outside.
double range_to_rim_m(const BoundingBox& box, const Pose2& T_robot_beam) {
  const double dx = std::cos(T_robot_beam.theta_rad);
  const double dy = std::sin(T_robot_beam.theta_rad);
  const std::array<std::array<double, 3>, 4> sides = {{{box.front_m, T_robot_beam.x_m, dx},
                                                       {box.back_m, -T_robot_beam.x_m, -dx},
                                                       {box.left_m, T_robot_beam.y_m, dy},
                                                       {box.right_m, -T_robot_beam.y_m, -dy}}};
  double range_m = open_m;
  for (const auto& [limit_m, start_m, towards] : sides)
    if (towards > 0.0) range_m = std::min(range_m, std::max(0.0, limit_m - start_m) / towards);
  return range_m;
}

}  // namespace

Scan correct_to_bounding_box(const Scan& scan, bool correct_no_echo) {
  validate(scan);
  const BoundingBox box = box_of(scan);
  Scan corrected = scan;
  for (std::size_t b = 0; b < scan.ranges_m.size(); ++b) {
    const Beam& beam = scan.sensor->beams[b];
    const Reading reading = classify(beam, scan.ranges_m[b]);
    if (reading == Reading::invalid || (reading == Reading::no_echo && !correct_no_echo)) continue;
    const auto rim_m = static_cast<float>(range_to_rim_m(box, beam.T_robot_beam));
    if (rim_m < scan.ranges_m[b] && classify(beam, rim_m) == Reading::echo) corrected.ranges_m[b] = rim_m;
  }
  return corrected;
}

}  // namespace landfall
