// Scans in, maps out.
#pragma once

#include <span>

#include "landfall/grid_map.hpp"
#include "landfall/scan.hpp"
#include "landfall/slam.hpp"

namespace landfall {

struct MappingOptions {
  double resolution_m = 0.05;
  double log_odds_hit = 0.85;
  double log_odds_miss = -0.4;
  double occupied_log_odds = 0.4;  // at or above: occupied
  double free_log_odds = -0.2;     // at or below: free; between: unknown
  double max_log_odds = 3.5;
  double range_max_m = 0.0;  // longer echoes free their first range_max_m only; 0: no limit
  double margin_m = 1.0;
};

// Occupancy from scans at known poses: every scan's T_map_robot must be set. Log odds are added along
// each beam (Moravec & Elfes 1985; Thrun et al., Probabilistic Robotics, 9.2), once a cell and scan, where
// a hit outweighs misses; a beam without echo frees nothing, one with a half-angle counts by its centre
// line; the grid covers all echoes and poses, its corner at a multiple of the resolution.
// Throws Error{invalid_argument}: no scans, a scan without pose; Error{too_large}: a map beyond limits.
GridMap map_from_known_poses(std::span<const Scan> scans, const MappingOptions& options = {});

}  // namespace landfall
