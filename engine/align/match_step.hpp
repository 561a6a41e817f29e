// One step of a window: where the later scan may lie beside the earlier one.
#pragma once

#include <vector>

#include "engine/align/odometry_step.hpp"
#include "engine/align/scan_view.hpp"

namespace landfall::internal {

struct StepMatch {
  Pose2 T_before_after;
  double overlap_share = 0.0;
};

// The most probable distinct ones, best first, each refined. Empty where a scan has no points.
std::vector<StepMatch> match_step(const ScanView& before, const ScanView& after, const OdometryStep& step);

}  // namespace landfall::internal
