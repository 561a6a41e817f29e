// A scan matched to the map built so far.
#pragma once

#include <vector>

#include "engine/mapping/slam/evidence_grid.hpp"
#include "engine/mapping/slam/prepared_scan.hpp"
#include "engine/mapping/slam/surface_map.hpp"

namespace landfall::internal {

struct MapSoFar {
  EvidenceGrid grid;
  SurfaceMap surfaces;
  std::vector<Pose2> path;  // of the scans that it is made of
};

struct Match {
  Pose2 T_map_robot;
  double fit = 0.0;        // share of the valid echoes in occupied cells
  double agreement = 0.0;  // share, of the surface points that meet something known, that lie on surfaces
  int on_surfaces = 0;
  double misfit = 1.0;  // mean over the surface points, 0 on a surface, 1 far from all
};

// How a scan lies from there.
Match judge(const MapSoFar& map, const PreparedScan& scan, const Pose2& T_map_robot);

// It lies on what is known well enough, and on enough of it.
bool is_acceptable(const Match& match, const PreparedScan& scan, const SlamOptions& options);

// The swarm's best around a predicted pose, with options.refine polished; so is the predicted pose itself,
// which is preferred where it fits as well: along a corridor the cells do not tell one place from the next.
Match match_by_swarm(const MapSoFar& map, const PreparedScan& scan, const Pose2& T_map_predicted,
                     const SlamOptions& options, std::uint32_t scan_number);

// Half widths of a window around a predicted pose.
struct SearchReach {
  double translation_m = 0.0;
  double rotation_rad = 0.0;
};
// The best poses of the window by the method branch_and_bound, the most probable first; judged, and polished
// with options.refine.
std::vector<Match> match_in_window(const MapSoFar& map, const Scan& scan, const PreparedScan& prepared,
                                   const Pose2& T_map_predicted, const SearchReach& reach,
                                   const SlamOptions& options);

}  // namespace landfall::internal
