#include "engine/priors/gaussian_density.hpp"

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
  // Solved in sigmas: variances may differ by more orders of magnitude than a determinant can hold. A line or
  // a point gets a little thickness.
  constexpr double thickness = 1e-10;
  const Eigen::Vector3d scale = sigma_.cwiseInverse();
  Eigen::Matrix3d correlation = scale.asDiagonal() * covariance * scale.asDiagonal();
  correlation.diagonal().array() += thickness;
  information_ = scale.asDiagonal() * correlation.inverse() * scale.asDiagonal();
}

Eigen::Vector3d GaussianDensity::off(const Pose2& T_map_robot) const {
  return {T_map_robot.x_m - T_map_mean_.x_m, T_map_robot.y_m - T_map_mean_.y_m,
          wrap_angle(T_map_robot.theta_rad - T_map_mean_.theta_rad)};
}

double GaussianDensity::log(const Pose2& T_map_robot) const {
  const Eigen::Vector3d from_mean = off(T_map_robot);
  return -0.5 * from_mean.dot(information_ * from_mean);
}

GaussianDensity::Line GaussianDensity::along(const Pose2& T_map_first, double step_x_m,
                                             double step_y_m) const {
  const Eigen::Vector3d from_mean = off(T_map_first);
  const Eigen::Vector3d step(step_x_m, step_y_m, 0.0);
  const Eigen::Vector3d pull = information_ * step;
  return {.at0 = -0.5 * from_mean.dot(information_ * from_mean),
          .slope = -from_mean.dot(pull),
          .curve = -0.5 * step.dot(pull)};
}

}  // namespace landfall::internal
