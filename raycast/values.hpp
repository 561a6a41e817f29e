// Plain values in one frame of the caller's choice, metres and radians.
#pragma once

#include "raycast/grid_walk.hpp"

namespace landfall::raycast {

struct Segment {
  double ax_m, ay_m, bx_m, by_m;
};

struct Pose {
  double x_m, y_m, theta_rad;
};

// Mount in the frame of the pose it is cast from. A half-angle makes it a cone.
struct Beam {
  double x_m, y_m, theta_rad;
  double half_angle_rad;
  double range_max_m;
};

struct Ray {
  double x_m, y_m;
  float dx, dy;  // unit direction
  float range_max_m;
};

// A grid where it lies.
struct PlacedGrid {
  Grid grid;
  double resolution_m = 0.0;
  Pose T_frame_grid{};
};

}  // namespace landfall::raycast
