// Which match of every step: the sequence that fits the scans and odometry best as a whole.
#pragma once

#include <span>
#include <vector>

#include "engine/align/match_step.hpp"
#include "engine/align/refine_jointly.hpp"

namespace landfall::internal {

// T_reference_robot of every scan. matches[k] are those of window.steps[k]; where there are none, odometry's
// step is taken.
//
// A scan must also fit the one before its neighbour. How good odometry is, is not known: its noise is the
// stated one times a factor common to all steps of the window, so that its deviations have a multivariate
// Cauchy density; where it agrees with most matches, it decides the others.
std::vector<Pose2> choose_chain(const ScanWindow& window, std::span<const std::vector<StepMatch>> matches);

}  // namespace landfall::internal
