#include "engine/mapping/tbf/sonar_reading.hpp"

#include <algorithm>
#include <cstddef>
#include <numbers>

namespace landfall::internal {
namespace {

constexpr double least_sigma_m = 1e-3;  // a sensor may be stated to be without noise

}  // namespace

std::vector<SonarReading> sonar_readings(const Scan& scan, std::uint32_t index) {
  std::vector<SonarReading> readings;
  for (std::size_t b = 0; b < scan.ranges_m.size(); ++b) {
    const Beam& beam = scan.sensor->beams[b];
    if (classify(beam, scan.ranges_m[b]) != Reading::echo) continue;
    const double range_m = scan.ranges_m[b];
    const Pose2 T_map_beam = *scan.T_map_robot * beam.T_robot_beam;
    readings.push_back(
        {.arc = make_arc(T_map_beam, beam.half_angle_rad, range_m),
         .range_sigma_m = std::max(least_sigma_m,
                                   scan.sensor->range_noise_m + scan.sensor->range_noise_relative * range_m),
         .bearing_sigma_rad = beam.half_angle_rad / std::numbers::sqrt3,
         .scan = index,
         .beam = static_cast<std::uint32_t>(b)});
  }
  return readings;
}

}  // namespace landfall::internal
