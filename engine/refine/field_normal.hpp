// How a scan's end points lie on the likelihood field, linearised for Gauss-Newton (Kohlbrecher et al. 2011,
// section IV-C).
#pragma once

#include <Eigen/Core>

#include "engine/maps/prepared_state.hpp"
#include "engine/scans/end_points.hpp"

namespace landfall::internal {

enum class Residual {
  lack,  // 1 - field: the paper's. Flat near a wall, it listens to points that are off.
  root   // its square root, near a wall the distance: it listens to points that fit.
};

// Of poses (x_cells, y_cells, theta_rad) in the grid's frame; a step solves hessian * step = gradient.
struct FieldNormal {
  Eigen::Matrix3d hessian = Eigen::Matrix3d::Zero();
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
  double cost = 0.0;   // sum of the squared residuals
  double field = 0.0;  // sum over the points, each 0..1
};

FieldNormal linearise(const PreparedState& map, const EndPoints& points, const Eigen::Vector3d& pose,
                      Residual residual);

}  // namespace landfall::internal
