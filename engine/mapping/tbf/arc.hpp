// Beam arcs: what a sonar saw lies somewhere on one. Ivanjko, Petrovic & Miklic 2005, section 4.
#pragma once

#include <optional>

#include "landfall/pose2.hpp"

namespace landfall::internal {

// All points at `radius_m` from the centre, seen from there within the half-angle of the axis.
struct Arc {
  Point2 center_map{};
  double axis_x = 1.0;  // unit vector
  double axis_y = 0.0;
  double half_angle_rad = 0.0;
  double cos_half_angle = 1.0;
  double radius_m = 0.0;
};

// From the sonar's place and direction. half_angle_rad is below pi / 2.
Arc make_arc(const Pose2& T_map_sonar, double half_angle_rad, double radius_m);
Point2 middle(const Arc& arc);
// No point of the arc is farther from its middle than this.
double reach_m(const Arc& arc);
// Whether the point, at any distance, is seen from the centre within the half-angle.
bool in_lobe(const Arc& arc, const Point2& p_map);
// Angle from the point's direction to the axis, counter-clockwise, in (-pi, pi].
double axis_offset_rad(const Arc& arc, const Point2& p_map);

// Where two arcs cross; of two crossings the one nearer to both axes. None where they do not, or where they
// have one centre.
std::optional<Point2> intersect(const Arc& a, const Arc& b);

}  // namespace landfall::internal
