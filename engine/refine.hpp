// A candidate polished below the grid step.
#pragma once

#include <array>

#include "engine/end_points.hpp"
#include "engine/prepared_state.hpp"

namespace landfall::internal {

struct Refined {
  Pose2 T_map_robot;
  std::array<double, 9> covariance{};  // map frame, row by row
  double share = 0.0;                  // mean of the interpolated field over the end points, 0..1
};

// Gauss-Newton on the interpolated likelihood field (Kohlbrecher et al. 2011, section IV-C), damped;
// stays within one and a half cells and heading steps of the start.
Refined refine(const PreparedState& map, const EndPoints& points, const Lattice& lattice,
               const Pose2& T_map_start);

}  // namespace landfall::internal
