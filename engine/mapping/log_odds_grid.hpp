// Cells that sum the evidence of scans (Moravec & Elfes 1985; Thrun, Burgard & Fox 2005, Probabilistic
// Robotics, table 9.1), with a line as the inverse sensor model: a beam's cells are missed up to the cell
// of its echo, which is hit. Changed: within one scan a cell counts once, as a hit where any beam ends in
// it, so that dense beams near the robot do not outvote a wall that one of them saw.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "landfall/mapping.hpp"

namespace landfall::internal {

// What one echo tells. A beam with a half-angle counts by its centre line.
struct BeamLine {
  Point2 from_map;
  Point2 to_map;
  bool hit;  // false: the echo lies beyond range_max_m, where the line ends
};

// The lines of a scan's echoes; its T_map_robot is set. range_max_m 0: no limit.
std::vector<BeamLine> beam_lines(const Scan& scan, double range_max_m);

class LogOddsGrid {
 public:
  // `grid` gives the place of the cells; its axes are the map's.
  LogOddsGrid(GridMap grid, const MappingOptions& options);

  // The lines of one scan. Cells beyond the grid are passed over.
  void add_scan(std::span<const BeamLine> lines);
  [[nodiscard]] GridMap to_map() &&;

 private:
  void add_misses(const BeamLine& line);
  void add(CellIndex cell, double evidence);

  GridMap grid_;
  MappingOptions options_;
  std::vector<float> log_odds_;
  std::vector<std::uint32_t> seen_in_;  // the last scan, from 1, that said something of the cell
  std::uint32_t scan_number_ = 0;
};

}  // namespace landfall::internal
