#include "landfall/pose2.hpp"

#include <cmath>
#include <numbers>

namespace landfall {

double wrap_angle(double angle_rad) {
  constexpr double pi = std::numbers::pi;
  if (angle_rad > -pi && angle_rad <= pi) return angle_rad;
  const double wrapped = std::remainder(angle_rad, 2.0 * pi);
  return wrapped <= -pi ? pi : wrapped;
}

double angle_distance(double a_rad, double b_rad) {
  return std::abs(wrap_angle(a_rad - b_rad));
}

Point2 operator*(const Pose2& T_a_b, const Point2& p_b) {
  const double c = std::cos(T_a_b.theta_rad);
  const double s = std::sin(T_a_b.theta_rad);
  return {T_a_b.x_m + c * p_b.x_m - s * p_b.y_m, T_a_b.y_m + s * p_b.x_m + c * p_b.y_m};
}

Pose2 operator*(const Pose2& T_a_b, const Pose2& T_b_c) {
  const Point2 p_a = T_a_b * Point2{T_b_c.x_m, T_b_c.y_m};
  return {p_a.x_m, p_a.y_m, wrap_angle(T_a_b.theta_rad + T_b_c.theta_rad)};
}

Pose2 inverse(const Pose2& T_a_b) {
  const double c = std::cos(T_a_b.theta_rad);
  const double s = std::sin(T_a_b.theta_rad);
  return {-c * T_a_b.x_m - s * T_a_b.y_m, s * T_a_b.x_m - c * T_a_b.y_m, wrap_angle(-T_a_b.theta_rad)};
}

double translation_distance(const Pose2& a, const Pose2& b) {
  return std::hypot(a.x_m - b.x_m, a.y_m - b.y_m);
}

bool is_finite(const Pose2& pose) {
  return std::isfinite(pose.x_m) && std::isfinite(pose.y_m) && std::isfinite(pose.theta_rad);
}

}  // namespace landfall
