#include "raycast/wedge.hpp"

#include <algorithm>
#include <cmath>

namespace landfall::raycast {

void Box::add(const Segment& wall) {
  min_x_m = std::min({min_x_m, wall.ax_m, wall.bx_m});
  min_y_m = std::min({min_y_m, wall.ay_m, wall.by_m});
  max_x_m = std::max({max_x_m, wall.ax_m, wall.bx_m});
  max_y_m = std::max({max_y_m, wall.ay_m, wall.by_m});
}

Wedge::Wedge(double apex_x_m, double apex_y_m, double theta_rad, double half_angle_rad)
    : apex_x_m_(apex_x_m),
      apex_y_m_(apex_y_m),
      normals_{{-std::sin(theta_rad - half_angle_rad), std::cos(theta_rad - half_angle_rad)},
               {std::sin(theta_rad + half_angle_rad), -std::cos(theta_rad + half_angle_rad)}} {}

// Clips a + t (b - a), 0 <= t <= 1, by the wedge's two sides (Liang and Barsky 1984).
double Wedge::squared_distance(const Segment& wall) const {
  const double ax = wall.ax_m - apex_x_m_;
  const double ay = wall.ay_m - apex_y_m_;
  const double dx = wall.bx_m - wall.ax_m;
  const double dy = wall.by_m - wall.ay_m;
  double t_first = 0.0;
  double t_last = 1.0;
  for (const Normal& n : normals_) {
    const double at_a = n.x * ax + n.y * ay;
    const double change = n.x * dx + n.y * dy;
    if (change > 0.0)
      t_first = std::max(t_first, -at_a / change);
    else if (change < 0.0)
      t_last = std::min(t_last, -at_a / change);
    else if (at_a < 0.0)
      return std::numeric_limits<double>::infinity();
  }
  if (t_first > t_last) return std::numeric_limits<double>::infinity();
  const double length_squared = dx * dx + dy * dy;
  const double t_foot = length_squared > 0.0 ? -(ax * dx + ay * dy) / length_squared : 0.0;
  const double t = std::clamp(t_foot, t_first, t_last);
  const double x = ax + t * dx;
  const double y = ay + t * dy;
  return x * x + y * y;
}

double Wedge::squared_lower_bound(const Box& box) const {
  const double min_x = box.min_x_m - apex_x_m_;
  const double min_y = box.min_y_m - apex_y_m_;
  const double max_x = box.max_x_m - apex_x_m_;
  const double max_y = box.max_y_m - apex_y_m_;
  for (const Normal& n : normals_) {
    const double largest = std::max(n.x * min_x, n.x * max_x) + std::max(n.y * min_y, n.y * max_y);
    if (largest < 0.0) return std::numeric_limits<double>::infinity();
  }
  const double outside_x = std::max({min_x, -max_x, 0.0});
  const double outside_y = std::max({min_y, -max_y, 0.0});
  return outside_x * outside_x + outside_y * outside_y;
}

}  // namespace landfall::raycast
