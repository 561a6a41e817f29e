// A Gaussian over poses, solved once.
#pragma once

#include <Eigen/Core>

#include "engine/priors/lattice.hpp"
#include "landfall/prior.hpp"

namespace landfall::internal {

class GaussianDensity {
 public:
  GaussianDensity() = default;
  // A direction without spread is given a little of the lattice's own step.
  GaussianDensity(const Lattice& lattice, const Gaussian& gaussian);

  // -mahalanobis^2 / 2.
  [[nodiscard]] double log(const Pose2& T_map_robot) const;
  // log() along a line of poses of one heading, k steps from T_map_first: a parabola.
  struct Line {
    double at0;
    double slope;
    double curve;  // negative
    [[nodiscard]] double log(double k) const { return at0 + k * (slope + k * curve); }
  };
  [[nodiscard]] Line along(const Pose2& T_map_first, double step_x_m, double step_y_m) const;
  [[nodiscard]] const Pose2& T_map_mean() const { return T_map_mean_; }
  [[nodiscard]] double sigma_x_m() const { return sigma_[0]; }
  [[nodiscard]] double sigma_y_m() const { return sigma_[1]; }
  [[nodiscard]] double sigma_theta_rad() const { return sigma_[2]; }

 private:
  [[nodiscard]] Eigen::Vector3d off(const Pose2& T_map_robot) const;

  Pose2 T_map_mean_;
  Eigen::Matrix3d information_ = Eigen::Matrix3d::Zero();
  Eigen::Vector3d sigma_ = Eigen::Vector3d::Zero();
};

}  // namespace landfall::internal
