// A grid as text, the way drawn_map.hpp reads it.
#pragma once

#include <string>
#include <vector>

#include "landfall/grid_map.hpp"

namespace landfall::testing {

inline std::vector<std::string> drawing_of(const GridMap& map) {
  std::vector<std::string> lines;
  for (int row = map.height_cells - 1; row >= 0; --row) {
    std::string line;
    for (int col = 0; col < map.width_cells; ++col) {
      const Occupancy cell = map.at({.col = col, .row = row});
      line += cell == Occupancy::occupied ? '#' : cell == Occupancy::free ? '.' : '?';
    }
    lines.push_back(line);
  }
  return lines;
}

}  // namespace landfall::testing
