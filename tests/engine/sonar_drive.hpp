// Sonars for tests, and readings of straight walls by hand.
#pragma once

#include <memory>
#include <numbers>
#include <vector>

#include "landfall/scan.hpp"

namespace landfall::testing {

inline constexpr double degree_rad = std::numbers::pi / 180.0;
inline constexpr double lobe_rad = 12.5 * degree_rad;

// One beam per direction, mounted at the robot's centre; echoes up to 5 m.
inline std::shared_ptr<const Sensor> sonars(const std::vector<double>& directions_deg) {
  Sensor sensor{.name = "sonars", .beams = {}, .range_noise_m = 0.01, .range_noise_relative = 0.01};
  for (const double direction_deg : directions_deg)
    sensor.beams.push_back({.T_robot_beam = {0.0, 0.0, direction_deg * degree_rad},
                            .half_angle_rad = lobe_rad,
                            .range_max_m = 5.0});
  return std::make_shared<const Sensor>(std::move(sensor));
}

inline Scan sonar_scan(const std::shared_ptr<const Sensor>& sensor, const Pose2& T_map_robot,
                       const std::vector<float>& ranges_m) {
  return {.sensor = sensor, .ranges_m = ranges_m, .T_map_robot = T_map_robot};
}

// A drive along x, 5 cm a scan, with one sonar to the left that reads `ranges_m`.
inline std::vector<Scan> drive_along(const std::vector<float>& ranges_m, double step_m = 0.05) {
  std::vector<Scan> scans;
  scans.reserve(ranges_m.size());
  const auto sensor = sonars({90.0});
  for (const float range_m : ranges_m)
    scans.push_back(sonar_scan(sensor, {step_m * static_cast<double>(scans.size()), 0.0, 0.0}, {range_m}));
  return scans;
}

}  // namespace landfall::testing
