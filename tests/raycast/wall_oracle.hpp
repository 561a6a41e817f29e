// The nearest crossing of a ray with any of the walls, one by one, in double.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "raycast/scene.hpp"

namespace landfall::testing {

// +inf: none within range_max_m. The ray starts at pose's place and looks along its heading, shifted to
// its left by shift_m first.
inline double crossed_range_m(std::span<const raycast::Segment> walls, const raycast::Pose& pose,
                              double range_max_m, double shift_m = 0.0) {
  const double c = std::cos(pose.theta_rad);
  const double s = std::sin(pose.theta_rad);
  double nearest_m = std::numeric_limits<double>::infinity();
  for (const raycast::Segment& wall : walls) {
    // In the ray's frame: it runs along x from the origin.
    const double ax = c * (wall.ax_m - pose.x_m) + s * (wall.ay_m - pose.y_m);
    const double ay = c * (wall.ay_m - pose.y_m) - s * (wall.ax_m - pose.x_m) - shift_m;
    const double bx = c * (wall.bx_m - pose.x_m) + s * (wall.by_m - pose.y_m);
    const double by = c * (wall.by_m - pose.y_m) - s * (wall.bx_m - pose.x_m) - shift_m;
    if ((ay > 0.0) == (by > 0.0)) continue;
    const double x = ax + (bx - ax) * ay / (ay - by);
    if (x >= 0.0) nearest_m = std::min(nearest_m, x);
  }
  return nearest_m <= range_max_m ? nearest_m : std::numeric_limits<double>::infinity();
}

}  // namespace landfall::testing
