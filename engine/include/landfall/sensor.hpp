// Range sensors: a list of beams. A laser scanner, two scanners back to back and a ring of sonars
// differ only in their beams.
#pragma once

#include <string>
#include <vector>

#include "landfall/pose2.hpp"

namespace landfall {

struct Beam {
  Pose2 T_robot_beam{};         // mount: origin of the ray, and its direction as the heading
  double half_angle_rad = 0.0;  // 0: a ray. A cone of 12 degrees has 6 degrees here
  double range_min_m = 0.0;     // a shorter reading is invalid
  double range_max_m = 80.0;    // this or more means that nothing was hit
  friend bool operator==(const Beam&, const Beam&) = default;
};

struct Sensor {
  std::string name{};
  std::vector<Beam> beams{};
  double range_noise_m = 0.01;        // one sigma, constant part
  double range_noise_relative = 0.0;  // one sigma, part that grows with the range (0.01: 1 %)
  friend bool operator==(const Sensor&, const Sensor&) = default;
};

// An evenly spaced fan: beam i points to first_rad + i * step_rad in the mount's frame.
struct FanOptions {
  std::string name = "laser";
  int beams = 180;
  double first_rad = 0.0;
  double step_rad = 0.0;
  Pose2 T_robot_sensor{};
  double half_angle_rad = 0.0;
  double range_min_m = 0.0;
  double range_max_m = 80.0;
  double range_noise_m = 0.01;
  double range_noise_relative = 0.0;
};
Sensor make_fan(const FanOptions& options);

// Throws Error{invalid_argument} that names the beam and the field: no beams (or over a million),
// a value that is not finite, a half-angle outside [0, pi), limits that are negative or reversed.
void validate(const Sensor& sensor);

}  // namespace landfall
