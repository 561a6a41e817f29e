// The ring of sonars of method `grid`'s tests, and the paper's lattice (Courcelle & Horn 1999).
#pragma once

#include <cmath>
#include <memory>
#include <numbers>

#include "landfall/search.hpp"
#include "landfall/sensor.hpp"

namespace landfall::testing {

// 14 sonars with cones of 12 degrees around a robot of 0.3 m.
inline std::shared_ptr<const Sensor> sonar_ring(double range_noise_m = 0.0) {
  Sensor sensor{.name = "ring", .beams = {}, .range_noise_m = range_noise_m};
  for (int k = 0; k < 14; ++k) {
    const double axis_rad = k * 2.0 * std::numbers::pi / 14.0;
    sensor.beams.push_back({.T_robot_beam = {0.3 * std::cos(axis_rad), 0.3 * std::sin(axis_rad), axis_rad},
                            .half_angle_rad = std::numbers::pi / 30.0,
                            .range_max_m = 8.0});
  }
  return std::make_shared<const Sensor>(sensor);
}

inline SearchOptions grid_options(const char* method, double distinct_m, double distinct_deg) {
  return {.method = method,
          .translation_step_m = 0.1,
          .rotation_step_rad = std::numbers::pi / 36.0,
          .robot_radius_m = 0.3,
          .distinct_translation_m = distinct_m,
          .distinct_rotation_rad = distinct_deg * std::numbers::pi / 180.0};
}

}  // namespace landfall::testing
