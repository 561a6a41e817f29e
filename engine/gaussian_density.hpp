// A Gaussian over poses, solved once.
#pragma once

#include <Eigen/Core>

#include "engine/lattice.hpp"
#include "landfall/prior.hpp"

namespace landfall::internal {

class GaussianDensity {
 public:
  GaussianDensity() = default;
  // A direction without spread is given a little of the lattice's own step.
  GaussianDensity(const Lattice& lattice, const Gaussian& gaussian);

  // -mahalanobis^2 / 2.
  [[nodiscard]] double log(const Pose2& T_map_robot) const;
  [[nodiscard]] double sigma_x_m() const { return sigma_[0]; }
  [[nodiscard]] double sigma_y_m() const { return sigma_[1]; }
  [[nodiscard]] double sigma_theta_rad() const { return sigma_[2]; }

 private:
  Pose2 T_map_mean_;
  Eigen::Matrix3d information_ = Eigen::Matrix3d::Zero();
  Eigen::Vector3d sigma_ = Eigen::Vector3d::Zero();
};

}  // namespace landfall::internal
