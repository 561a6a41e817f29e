// Small motions of the plane, (v_x, v_y, omega) about a frame's origin, applied from the left: exp(d) T.
#pragma once

#include <Eigen/Core>
#include <cmath>

#include "landfall/pose2.hpp"

namespace landfall::internal {

// A motion in frame b's coordinates from the same in frame a's: exp(adjoint(T_b_a) d) T_b_a = T_b_a exp(d).
inline Eigen::Matrix3d adjoint(const Pose2& T_b_a) {
  const double c = std::cos(T_b_a.theta_rad);
  const double s = std::sin(T_b_a.theta_rad);
  Eigen::Matrix3d matrix;
  matrix << c, -s, T_b_a.y_m, s, c, -T_b_a.x_m, 0.0, 0.0, 1.0;
  return matrix;
}

// d of (x, y, theta) of T_before_after where both scans' poses move in the reference's frame:
// relative_jacobian * (d_after - d_before).
inline Eigen::Matrix3d relative_jacobian(const Pose2& T_reference_before, const Pose2& T_reference_after) {
  const double c = std::cos(T_reference_before.theta_rad);
  const double s = std::sin(T_reference_before.theta_rad);
  const double x = T_reference_after.x_m;
  const double y = T_reference_after.y_m;
  Eigen::Matrix3d matrix;
  matrix << c, s, s * x - c * y, -s, c, s * y + c * x, 0.0, 0.0, 1.0;
  return matrix;
}

inline Pose2 moved(const Eigen::Vector3d& d, const Pose2& T_reference_robot) {
  const Pose2 turned = Pose2{.x_m = 0.0, .y_m = 0.0, .theta_rad = d[2]} * T_reference_robot;
  return {.x_m = turned.x_m + d[0], .y_m = turned.y_m + d[1], .theta_rad = turned.theta_rad};
}

// From odometry to a pose: x, y, heading.
inline Eigen::Vector3d difference(const Pose2& to, const Pose2& from) {
  return {to.x_m - from.x_m, to.y_m - from.y_m, wrap_angle(to.theta_rad - from.theta_rad)};
}

}  // namespace landfall::internal
