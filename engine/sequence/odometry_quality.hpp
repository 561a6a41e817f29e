// How good odometry proves over a log.
#pragma once

#include <span>
#include <vector>

#include "engine/sequence/odometry.hpp"
#include "landfall/search.hpp"

namespace landfall::internal {

// Of the increments between neighbours: their error is the stated one times a factor, one for translations
// and one for rotations; now and then (a slip) it is the stated one.
struct OdometryQuality {
  double translation_factor = 1.0;
  double rotation_factor = 1.0;
};

// How far the step between two hypotheses is off odometry's.
struct StepOff {
  double translation_m;
  double rotation_rad;
};
inline StepOff step_off(const Pose2& T_map_before, const Pose2& T_map_after, const Pose2& T_before_after) {
  const Pose2 T_moved = inverse(T_map_before) * T_map_after;
  return {.translation_m = translation_distance(T_moved, T_before_after),
          .rotation_rad = angle_distance(T_moved.theta_rad, T_before_after.theta_rad)};
}

// Odometry's uncertainty, as good as it proved, and that of a hypothesis together.
OdometrySigma with_pose_sigma(const OdometrySigma& sigma, const OdometryQuality& quality);

// Log density of a step that is so far off; hypotheses are themselves uncertain.
double log_step_density(const OdometryNoise& noise, const OdometryQuality& quality,
                        const Pose2& T_before_after, const StepOff& off);

// The most probable factors, from the hypotheses of neighbours: each pair of these may be the right one, with
// its probability, or none is, and odometry says nothing. About 1 is expected beforehand, so that few
// hypotheses do not make odometry better or worse than it is stated to be (empirical Bayes).
// T_odom_robot[i] is odometry under results[i]. uniform_density: of poses where no hypothesis is right.
OdometryQuality judge_odometry(std::span<const SearchResult> results, std::span<const Pose2> T_odom_robot,
                               const OdometryNoise& noise, double uniform_density);

}  // namespace landfall::internal
