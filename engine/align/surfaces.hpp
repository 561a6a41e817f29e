// What a scan saw, as points on surfaces.
#pragma once

#include <span>
#include <vector>

#include "landfall/scan.hpp"

namespace landfall::internal {

// All in the robot's frame.
struct Echo {
  Point2 p_origin;  // of the beam
  Point2 p_end;
  double range_m = 0.0;
  bool ray = true;  // false: a cone, its end point is only roughly there
};

// Those that begin and end this close to the robot, in the order of the beams.
std::vector<Echo> echoes_within(const Scan& scan, double distance_m);

struct SurfacePoint {
  Point2 p;
  Point2 normal;  // unit length, towards the sensor
  bool has_normal = false;
};

// Echoes thinned to a few centimetres along the surfaces. A normal is that of the line through neighbouring
// echoes; corners, legs and cones have none.
std::vector<SurfacePoint> surface_points(std::span<const Echo> echoes);

}  // namespace landfall::internal
