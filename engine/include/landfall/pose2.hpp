// Planar poses and points; frames and units as in REP-103 (metres, radians, x forward, y left,
// counter-clockwise positive).
#pragma once

namespace landfall {

struct Point2 {
  double x_m = 0.0;
  double y_m = 0.0;
  friend bool operator==(const Point2&, const Point2&) = default;
};

// As T_a_b it takes points of frame b into frame a: p_a = T_a_b * p_b.
struct Pose2 {
  double x_m = 0.0;
  double y_m = 0.0;
  double theta_rad = 0.0;
  friend bool operator==(const Pose2&, const Pose2&) = default;
};

// T_a_b * T_b_c = T_a_c, its heading in (-pi, pi].
Pose2 operator*(const Pose2& T_a_b, const Pose2& T_b_c);
Point2 operator*(const Pose2& T_a_b, const Point2& p_b);
// inverse(T_a_b) = T_b_a.
Pose2 inverse(const Pose2& T_a_b);

// The same direction in (-pi, pi].
double wrap_angle(double angle_rad);
// |wrap(a - b)|, in [0, pi].
double angle_distance(double a_rad, double b_rad);
// Euclidean distance of the positions, metres.
double translation_distance(const Pose2& a, const Pose2& b);
bool is_finite(const Pose2& pose);

}  // namespace landfall
