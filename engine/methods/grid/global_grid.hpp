// The global grid: the map as +1 (occupied), -1 (free) and 0 (unknown).
#pragma once

#include <cstdint>
#include <vector>

#include "landfall/grid_map.hpp"

namespace landfall::internal {

enum class Contours : std::uint8_t {
  uncorrected,  // every cell of an obstacle is occupied
  corrected,    // only its contour: no sensor sees what lies behind (Courcelle & Horn 1999, section 5)
};

// Row by row. The contour is one cell thick: the occupied cells that share a side with one that is not; the
// obstacle's inside becomes unknown.
std::vector<std::int8_t> global_grid(const GridMap& map, Contours contours);

}  // namespace landfall::internal
