#include "engine/gaussian_density.hpp"

#include <Eigen/Dense>

namespace landfall::internal {

GaussianDensity::GaussianDensity(const Lattice& lattice, const Gaussian& gaussian)
    : T_map_mean_(gaussian.T_map_robot) {
  constexpr double share_of_step = 1.0 / 30.0;
  const double least_m = lattice.resolution_m * lattice.step_cells * share_of_step;
  const double least_rad = lattice.heading_step_rad() * share_of_step;
  Eigen::Matrix3d covariance = Eigen::Map<const Eigen::Matrix3d>(gaussian.covariance.data());
  covariance.diagonal() += Eigen::Vector3d(least_m, least_m, least_rad).cwiseAbs2();
  sigma_ = covariance.diagonal().cwiseSqrt();
  information_ = covariance.inverse();
}

double GaussianDensity::log(const Pose2& T_map_robot) const {
  const Eigen::Vector3d off(T_map_robot.x_m - T_map_mean_.x_m, T_map_robot.y_m - T_map_mean_.y_m,
                            wrap_angle(T_map_robot.theta_rad - T_map_mean_.theta_rad));
  return -0.5 * off.dot(information_ * off);
}

}  // namespace landfall::internal
