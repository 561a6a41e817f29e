#include "engine/mapping/log_odds_grid.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "raycast/grid_walk.hpp"

namespace landfall::internal {

std::vector<BeamLine> beam_lines(const Scan& scan, double range_max_m) {
  std::vector<BeamLine> lines;
  for (std::size_t b = 0; b < scan.ranges_m.size(); ++b) {
    const Beam& beam = scan.sensor->beams[b];
    if (classify(beam, scan.ranges_m[b]) != Reading::echo) continue;
    const Pose2 T_map_beam = *scan.T_map_robot * beam.T_robot_beam;
    const double range_m = scan.ranges_m[b];
    const bool hit = range_max_m == 0.0 || range_m <= range_max_m;
    lines.push_back({.from_map = {.x_m = T_map_beam.x_m, .y_m = T_map_beam.y_m},
                     .to_map = T_map_beam * Point2{.x_m = hit ? range_m : range_max_m, .y_m = 0.0},
                     .hit = hit});
  }
  return lines;
}

LogOddsGrid::LogOddsGrid(GridMap grid, const MappingOptions& options)
    : grid_(std::move(grid)),
      options_(options),
      log_odds_(grid_.cells.size(), 0.0f),
      seen_in_(grid_.cells.size(), 0) {}

void LogOddsGrid::add_scan(std::span<const BeamLine> lines) {
  ++scan_number_;
  for (const BeamLine& line : lines)
    if (line.hit) add(grid_.cell_of(line.to_map), options_.log_odds_hit);
  for (const BeamLine& line : lines) add_misses(line);
}

// Every cell before the one where the line ends.
void LogOddsGrid::add_misses(const BeamLine& line) {
  const double x = (line.from_map.x_m - grid_.T_map_grid.x_m) / grid_.resolution_m;
  const double y = (line.from_map.y_m - grid_.T_map_grid.y_m) / grid_.resolution_m;
  const double dx = (line.to_map.x_m - line.from_map.x_m) / grid_.resolution_m;
  const double dy = (line.to_map.y_m - line.from_map.y_m) / grid_.resolution_m;
  const CellIndex end = grid_.cell_of(line.to_map);
  for (raycast::CellWalk walk(x, y, dx, dy); walk.entered() <= 1.0; walk.step()) {
    const CellIndex cell{.col = walk.col(), .row = walk.row()};
    if (cell == end) return;
    add(cell, options_.log_odds_miss);
  }
}

void LogOddsGrid::add(CellIndex cell, double evidence) {
  if (!grid_.contains(cell)) return;
  const std::size_t i = grid_.index(cell);
  if (seen_in_[i] == scan_number_) return;
  seen_in_[i] = scan_number_;
  log_odds_[i] =
      static_cast<float>(std::clamp(log_odds_[i] + evidence, -options_.max_log_odds, options_.max_log_odds));
}

GridMap LogOddsGrid::to_map() && {
  for (std::size_t i = 0; i < log_odds_.size(); ++i)
    grid_.cells[i] = log_odds_[i] >= options_.occupied_log_odds ? Occupancy::occupied
                     : log_odds_[i] <= options_.free_log_odds   ? Occupancy::free
                                                                : Occupancy::unknown;
  return std::move(grid_);
}

}  // namespace landfall::internal
