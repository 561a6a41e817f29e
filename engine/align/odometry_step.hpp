// Odometry from one scan to the next.
#pragma once

#include "engine/sequence/odometry.hpp"
#include "landfall/pose2.hpp"

namespace landfall::internal {

struct OdometryStep {
  Pose2 T_before_after;
  OdometrySigma sigma;
};

// How far a pose lies from odometry's, in squared sigmas.
struct SquaredDeviation {
  double translation = 0.0;  // of two dimensions
  double rotation = 0.0;     // of one
};

inline SquaredDeviation squared_deviation(const OdometryStep& step, const Pose2& T_before_after) {
  const double off = translation_distance(step.T_before_after, T_before_after) / step.sigma.translation_m;
  const double turned =
      angle_distance(step.T_before_after.theta_rad, T_before_after.theta_rad) / step.sigma.rotation_rad;
  return {.translation = off * off, .rotation = turned * turned};
}

}  // namespace landfall::internal
