// A pose polished against exact walls, by the ranges that the scan's beams have from it.
//
// For maps whose walls are exact (floor plans): the likelihood field's cells do not carry an accuracy of
// 1 cm. On grids of real buildings the field is the better judge (refine.hpp).
#pragma once

#include <array>
#include <cstdint>

#include "engine/maps/prepared_state.hpp"
#include "landfall/scan.hpp"

namespace landfall::internal {

struct RefinedByRanges {
  Pose2 T_map_robot{};
  std::array<double, 9> covariance{};  // map frame, row by row
  std::int64_t rays_cast = 0;
};

// How far a refined pose may be from where it started.
struct RefineReach {
  double translation_m = 0.3;
  double rotation_rad = 0.15;
};

// Gauss-Newton on measured less simulated range, of beams without half-angle that have an echo; the
// derivatives are differences. Weights of Geman and McClure (1985), whose width shrinks to three times the
// sensor's noise, leave out what the map lacks. The start itself where nothing is to be gained.
RefinedByRanges refine_by_ranges(const PreparedState& map, const Scan& scan, const Pose2& T_map_start,
                                 const RefineReach& reach = {});

}  // namespace landfall::internal
