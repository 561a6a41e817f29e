// Maps drawn as text: '#' occupied, '.' free, '?' unknown; the first line is the top row.
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

#include "landfall/grid_map.hpp"

namespace landfall::testing {

inline GridMap drawn_map(const std::vector<std::string>& lines, double resolution_m = 1.0,
                         const Pose2& T_map_grid = {}) {
  GridMap map;
  map.height_cells = static_cast<int>(lines.size());
  map.width_cells = static_cast<int>(lines.at(0).size());
  map.resolution_m = resolution_m;
  map.T_map_grid = T_map_grid;
  for (auto line = lines.rbegin(); line != lines.rend(); ++line) {
    if (line->size() != lines[0].size()) throw std::invalid_argument("drawn_map: ragged lines");
    for (const char c : *line)
      map.cells.push_back(c == '#' ? Occupancy::occupied : c == '.' ? Occupancy::free : Occupancy::unknown);
  }
  return map;
}

}  // namespace landfall::testing
