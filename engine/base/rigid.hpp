// A pose whose sine and cosine are known, for many points.
#pragma once

#include <cmath>

#include "landfall/pose2.hpp"

namespace landfall::internal {

class Rigid {
 public:
  explicit Rigid(const Pose2& T_a_b)
      : cos_(std::cos(T_a_b.theta_rad)), sin_(std::sin(T_a_b.theta_rad)), x_m_(T_a_b.x_m), y_m_(T_a_b.y_m) {}

  [[nodiscard]] Point2 direction(const Point2& d_b) const {
    return {.x_m = cos_ * d_b.x_m - sin_ * d_b.y_m, .y_m = sin_ * d_b.x_m + cos_ * d_b.y_m};
  }
  [[nodiscard]] Point2 point(const Point2& p_b) const {
    const Point2 turned = direction(p_b);
    return {.x_m = x_m_ + turned.x_m, .y_m = y_m_ + turned.y_m};
  }

 private:
  double cos_, sin_, x_m_, y_m_;
};

}  // namespace landfall::internal
