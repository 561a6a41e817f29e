// A convex wedge of view, and what of a wall lies within it.
#pragma once

#include <limits>

#include "raycast/values.hpp"

namespace landfall::raycast {

struct Box {
  double min_x_m = std::numeric_limits<double>::infinity();
  double min_y_m = std::numeric_limits<double>::infinity();
  double max_x_m = -std::numeric_limits<double>::infinity();
  double max_y_m = -std::numeric_limits<double>::infinity();

  void add(const Segment& wall);
};

// All points p with inner normals n_i . (p - apex) >= 0: a half-angle of at most pi / 2.
class Wedge {
 public:
  Wedge(double apex_x_m, double apex_y_m, double theta_rad, double half_angle_rad);

  // Squared distance (m^2) from the apex to the nearest point of the wall's part within the wedge; +inf:
  // none is.
  [[nodiscard]] double squared_distance(const Segment& wall) const;
  // A lower bound of that for every wall within the box; +inf: no such wall reaches the wedge.
  [[nodiscard]] double squared_lower_bound(const Box& box) const;

 private:
  struct Normal {
    double x, y;
  };
  double apex_x_m_, apex_y_m_;
  Normal normals_[2];
};

}  // namespace landfall::raycast
