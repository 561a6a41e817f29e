// Symmetric 2 x 2 matrices: covariances of points of the map, m^2, and their inverses.
#pragma once

#include <algorithm>
#include <cmath>

#include "landfall/pose2.hpp"

namespace landfall::internal {

struct Symmetric2 {
  double xx = 0.0;
  double xy = 0.0;
  double yy = 0.0;

  [[nodiscard]] double det() const { return xx * yy - xy * xy; }
  // v^T M v
  [[nodiscard]] double quadratic(double x, double y) const {
    return xx * x * x + 2.0 * xy * x * y + yy * y * y;
  }
  [[nodiscard]] Point2 times(double x, double y) const {
    return {.x_m = xx * x + xy * y, .y_m = xy * x + yy * y};
  }
  // M += weight v v^T
  void add_outer(double x, double y, double weight) {
    xx += weight * x * x;
    xy += weight * x * y;
    yy += weight * y * y;
  }
};

// Of a positive definite one.
inline Symmetric2 inverse(const Symmetric2& m) {
  const double per_det = 1.0 / m.det();
  return {.xx = m.yy * per_det, .xy = -m.xy * per_det, .yy = m.xx * per_det};
}

// The largest eigenvalue of a positive semidefinite one.
inline double spectral_radius(const Symmetric2& m) {
  const double half_trace = 0.5 * (m.xx + m.yy);
  return half_trace + std::sqrt(std::max(0.0, half_trace * half_trace - m.det()));
}

}  // namespace landfall::internal
