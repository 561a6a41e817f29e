#include "engine/mapping/located_sonars.hpp"

#include <cstddef>
#include <numbers>

#include "engine/base/number_text.hpp"
#include "engine/mapping/log_odds_grid.hpp"
#include "engine/maps/grid_extent.hpp"
#include "landfall/error.hpp"

namespace landfall::internal {
namespace {

void validate_cones(const Sensor& sensor, const std::string& what) {
  for (std::size_t b = 0; b < sensor.beams.size(); ++b) {
    const double half_angle_rad = sensor.beams[b].half_angle_rad;
    if (half_angle_rad > 0.0 && half_angle_rad < std::numbers::pi / 2) continue;
    throw Error(ErrorCode::invalid_argument,
                what + ": sensor '" + sensor.name + "', beam " + std::to_string(b) + ": half_angle_rad is " +
                    number_text(half_angle_rad) + ", expected a sonar's, above 0 and below pi / 2");
  }
}

}  // namespace

void validate_located_sonars(std::span<const Scan> scans, const std::string& what) {
  if (scans.empty()) throw Error(ErrorCode::invalid_argument, what + ": no scans, expected at least one");
  const Sensor* checked = nullptr;
  for (std::size_t i = 0; i < scans.size(); ++i) {
    validate(scans[i]);
    if (scans[i].sensor.get() != checked) validate_cones(*scans[i].sensor, what);
    checked = scans[i].sensor.get();
    if (!scans[i].T_map_robot)
      throw Error(ErrorCode::invalid_argument, what + ": scan " + std::to_string(i) +
                                                   " has no T_map_robot, expected a pose in every scan");
  }
}

GridMap grid_around(std::span<const Scan> scans, double resolution_m, double margin_m,
                    const std::string& what) {
  Extent extent;
  for (const Scan& scan : scans) {
    extent.add({.x_m = scan.T_map_robot->x_m, .y_m = scan.T_map_robot->y_m});
    for (const BeamLine& line : beam_lines(scan, 0.0)) {
      extent.add(line.from_map);
      extent.add(line.to_map);
    }
  }
  return make_grid(
      extent, {.resolution_m = resolution_m, .margin_m = margin_m, .fill = Occupancy::unknown, .what = what});
}

void require_option(bool holds, const std::string& what, const char* field, double value,
                    const char* expected) {
  if (!holds)
    throw Error(ErrorCode::invalid_argument,
                what + ": " + field + " is " + number_text(value) + ", expected " + expected);
}

}  // namespace landfall::internal
