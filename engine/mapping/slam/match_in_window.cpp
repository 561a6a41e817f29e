#include <cmath>

#include "engine/mapping/slam/match.hpp"
#include "landfall/search.hpp"

namespace landfall::internal {
namespace {

constexpr double driven_m = 0.3;  // where a robot stood is free so far around

void add_free_disc(GridMap& map, const Pose2& T_map_robot) {
  const CellIndex center = map.cell_of({.x_m = T_map_robot.x_m, .y_m = T_map_robot.y_m});
  const int radius = static_cast<int>(std::ceil(driven_m / map.resolution_m));
  for (int row = center.row - radius; row <= center.row + radius; ++row)
    for (int col = center.col - radius; col <= center.col + radius; ++col) {
      const CellIndex cell{.col = col, .row = row};
      const bool inside = std::hypot(col - center.col, row - center.row) <= radius;
      if (inside && map.contains(cell) && map.at(cell) == Occupancy::unknown)
        map.cells[map.index(cell)] = Occupancy::free;
    }
}

// What the scan may see from the window, free where the robot was.
GridMap map_around(const MapSoFar& map, const Pose2& T_map_predicted, double radius_m) {
  const CellBox box{
      .low = map.grid.cell_of({.x_m = T_map_predicted.x_m - radius_m, .y_m = T_map_predicted.y_m - radius_m}),
      .high =
          map.grid.cell_of({.x_m = T_map_predicted.x_m + radius_m, .y_m = T_map_predicted.y_m + radius_m})};
  GridMap around = map.grid.to_map(&box);
  for (const Pose2& T_map_robot : map.path) add_free_disc(around, T_map_robot);
  return around;
}

}  // namespace

std::vector<Match> match_in_window(const MapSoFar& map, const Scan& scan, const PreparedScan& prepared,
                                   const Pose2& T_map_predicted, const SearchReach& reach,
                                   const SlamOptions& options) {
  const double radius_m = reach.translation_m + prepared.farthest_m + 1.0;
  const PreparedMap around(map_around(map, T_map_predicted, radius_m));
  const SearchResult result = search(around,
                                     {Window{.T_map_robot = T_map_predicted,
                                             .half_x_m = reach.translation_m,
                                             .half_y_m = reach.translation_m,
                                             .half_theta_rad = reach.rotation_rad}},
                                     scan, {.method = "branch_and_bound", .threads = options.threads});
  std::vector<Match> matches;
  for (const Hypothesis& hypothesis : result.hypotheses)
    matches.push_back(judge(map, prepared,
                            options.refine ? map.surfaces.refine(prepared.surfaces, hypothesis.T_map_robot)
                                           : hypothesis.T_map_robot_unrefined));
  return matches;
}

}  // namespace landfall::internal
