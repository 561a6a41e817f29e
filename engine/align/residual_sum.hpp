// Residuals along lines, summed up for Gauss-Newton, weighted after Geman and McClure.
#pragma once

#include "engine/align/point_to_line.hpp"

namespace landfall::internal {

class ResidualSum {
 public:
  static constexpr double outlier_m = 0.05;  // scale of the weights
  // One sigma of a residual. Neighbouring points share their faults, so that this is worse than a point's
  // own.
  static constexpr double sigma_m = 0.04;

  explicit ResidualSum(PairNormal& normal) : normal_(normal) {}

  // One residual along (n_x, n_y) at p. `off_m`: what its weight goes by.
  void add(double n_x, double n_y, const Point2& p, double residual_m, double off_m) {
    const double ratio = 1.0 + off_m * off_m / (outlier_m * outlier_m);
    const double weight = 1.0 / (sigma_m * sigma_m * ratio * ratio);
    const double n_theta = n_y * p.x_m - n_x * p.y_m;
    const double j[3] = {n_x, n_y, n_theta};
    for (int row = 0; row < 3; ++row) {
      normal_.gradient[row] += weight * residual_m * j[row];
      for (int col = 0; col <= row; ++col) normal_.hessian(row, col) += weight * j[row] * j[col];
    }
  }

 private:
  PairNormal& normal_;
};

}  // namespace landfall::internal
