// What odometry's increments are worth.
#pragma once

#include <cmath>
#include <string>

#include "landfall/align.hpp"

namespace landfall::internal {

struct OdometrySigma {
  double translation_m;
  double rotation_rad;
};

// A hypothesis is itself only good to about this much.
inline constexpr double pose_sigma_m = 0.1;
inline constexpr double pose_sigma_rad = 0.03;

// Throws Error{invalid_argument}, under the function's name, unless all are finite and not negative.
void check_odometry_noise(const std::string& function, const OdometryNoise& noise);

// One sigma of the error of an increment.
inline OdometrySigma odometry_sigma(const OdometryNoise& noise, const Pose2& T_before_after) {
  const double driven_m = std::hypot(T_before_after.x_m, T_before_after.y_m);
  const double turned_rad = std::abs(T_before_after.theta_rad);
  return {
      noise.translation_m + noise.translation_relative * driven_m + noise.translation_per_rad_m * turned_rad,
      noise.rotation_rad + noise.rotation_per_m_rad * driven_m + noise.rotation_relative * turned_rad};
}

}  // namespace landfall::internal
