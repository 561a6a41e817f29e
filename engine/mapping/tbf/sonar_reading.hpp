// One echo of one sonar: its beam arc in the map, and how sure range and bearing are.
// Ivanjko, Petrovic & Miklic 2005, equations 1 and 2.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/mapping/tbf/arc.hpp"
#include "landfall/scan.hpp"

namespace landfall::internal {

struct SonarReading {
  Arc arc;
  double range_sigma_m = 0.0;
  double bearing_sigma_rad = 0.0;  // of U(-half angle, half angle): half angle / sqrt(3)
  std::uint32_t scan = 0;
  std::uint32_t beam = 0;
};

// The echoes of a scan whose T_map_robot is set; `index` is the scan's.
std::vector<SonarReading> sonar_readings(const Scan& scan, std::uint32_t index);

}  // namespace landfall::internal
