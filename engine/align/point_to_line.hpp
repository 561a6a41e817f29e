// Point-to-line residuals of one scan's points beside another scan's surfaces (Chen & Medioni 1992; Censi
// 2008, An ICP variant using a point-to-line metric), weighted after Geman and McClure; points on corners and
// legs, which have no line, are held to each other.
#pragma once

#include <Eigen/Core>

#include "engine/align/scan_view.hpp"

namespace landfall::internal {

// In the fixed scan's frame: of motions exp(d) T_fixed_moving.
struct PairNormal {
  Eigen::Matrix3d hessian = Eigen::Matrix3d::Zero();
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
};

// Points farther than gate_m from the nearest one of the fixed scan stay out.
PairNormal point_to_line(const ScanView& fixed, const ScanView& moving, const Pose2& T_fixed_moving,
                         double gate_m);

}  // namespace landfall::internal
