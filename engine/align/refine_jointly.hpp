// All scans of a window matched to each other at once, and to odometry, by Gauss-Newton (Lu & Milios 1997,
// Globally consistent range scan alignment). Changed: the matches are point to line, found anew in every
// iteration.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "engine/align/odometry_step.hpp"
#include "engine/align/scan_view.hpp"

namespace landfall::internal {

struct ScanWindow {
  std::span<const ScanView* const> scans;
  std::span<const OdometryStep> steps;  // steps[k]: from scan k to scan k + 1
  std::size_t reference = 0;            // the scan whose pose stays
};

struct RefinedWindow {
  std::vector<Pose2> T_reference_robot;
  // Of the matches alone, without odometry; three rows a scan, of left twists in the reference's frame.
  Eigen::MatrixXd information;
};

// From the start to the nearest optimum.
RefinedWindow refine_jointly(const ScanWindow& window, std::vector<Pose2> T_reference_start);

// Takes one scan's motion out of a system of normal equations.
void hold_scan(std::size_t scan, Eigen::MatrixXd& hessian);

}  // namespace landfall::internal
