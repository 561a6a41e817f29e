// Where one scan may lie beside another: every pose that odometry allows is scored (after Olson 2009,
// Real-time correlative scan matching). Changed: all translations of a heading at once, row by row of the
// field, in place of his two resolutions; what a scan saw as free counts; odometry is a prior.
#pragma once

#include <vector>

#include "engine/align/odometry_step.hpp"
#include "engine/align/scan_view.hpp"

namespace landfall::internal {

// T_before_after of the most probable distinct poses, best first, at most a dozen; good to the field's
// resolution and half a degree. Empty where a scan has no points.
std::vector<Pose2> correlate(const ScanView& before, const ScanView& after, const OdometryStep& step);

}  // namespace landfall::internal
