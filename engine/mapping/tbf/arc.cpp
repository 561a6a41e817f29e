#include "engine/mapping/tbf/arc.hpp"

#include <cmath>

namespace landfall::internal {
namespace {

// How far off both axes, as shares of the half-angles.
double obliqueness(const Arc& a, const Arc& b, const Point2& p_map) {
  const double off_a = axis_offset_rad(a, p_map) / a.half_angle_rad;
  const double off_b = axis_offset_rad(b, p_map) / b.half_angle_rad;
  return off_a * off_a + off_b * off_b;
}

}  // namespace

Arc make_arc(const Pose2& T_map_sonar, double half_angle_rad, double radius_m) {
  return {.center_map = {.x_m = T_map_sonar.x_m, .y_m = T_map_sonar.y_m},
          .axis_x = std::cos(T_map_sonar.theta_rad),
          .axis_y = std::sin(T_map_sonar.theta_rad),
          .half_angle_rad = half_angle_rad,
          .cos_half_angle = std::cos(half_angle_rad),
          .radius_m = radius_m};
}

Point2 middle(const Arc& arc) {
  return {.x_m = arc.center_map.x_m + arc.radius_m * arc.axis_x,
          .y_m = arc.center_map.y_m + arc.radius_m * arc.axis_y};
}

double reach_m(const Arc& arc) {
  return 2.0 * arc.radius_m * std::sin(0.5 * arc.half_angle_rad);
}

bool in_lobe(const Arc& arc, const Point2& p_map) {
  const double x = p_map.x_m - arc.center_map.x_m;
  const double y = p_map.y_m - arc.center_map.y_m;
  return x * arc.axis_x + y * arc.axis_y >= std::sqrt(x * x + y * y) * arc.cos_half_angle;
}

double axis_offset_rad(const Arc& arc, const Point2& p_map) {
  const double x = p_map.x_m - arc.center_map.x_m;
  const double y = p_map.y_m - arc.center_map.y_m;
  return std::atan2(x * arc.axis_y - y * arc.axis_x, x * arc.axis_x + y * arc.axis_y);
}

std::optional<Point2> intersect(const Arc& a, const Arc& b) {
  const double dx = b.center_map.x_m - a.center_map.x_m;
  const double dy = b.center_map.y_m - a.center_map.y_m;
  const double squared = dx * dx + dy * dy;
  if (!(squared > 0.0)) return std::nullopt;
  // Along the line of centres, in units of their distance: where both circles' common chord crosses it.
  const double along = 0.5 * (1.0 + (a.radius_m * a.radius_m - b.radius_m * b.radius_m) / squared);
  const double across_squared = a.radius_m * a.radius_m / squared - along * along;
  if (!(across_squared >= 0.0)) return std::nullopt;
  const double across = std::sqrt(across_squared);
  const Point2 foot{.x_m = a.center_map.x_m + along * dx, .y_m = a.center_map.y_m + along * dy};
  const Point2 left{.x_m = foot.x_m - across * dy, .y_m = foot.y_m + across * dx};
  const Point2 right{.x_m = foot.x_m + across * dy, .y_m = foot.y_m - across * dx};
  const bool in_left = in_lobe(a, left) && in_lobe(b, left);
  const bool in_right = in_lobe(a, right) && in_lobe(b, right);
  if (in_left && in_right) return obliqueness(a, b, left) <= obliqueness(a, b, right) ? left : right;
  if (in_left) return left;
  if (in_right) return right;
  return std::nullopt;
}

}  // namespace landfall::internal
