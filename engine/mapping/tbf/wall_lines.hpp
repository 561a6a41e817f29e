// Wall segments that line up, among the occupied cells of a map. Ivanjko, Petrovic & Miklic 2005, section 6,
// names the task; the way is a Hough transform (Duda & Hart 1972) whose lines are taken one by one.
#pragma once

#include <cstdint>
#include <span>

#include "landfall/grid_map.hpp"
#include "landfall/sonar_mapping.hpp"

namespace landfall::internal {

// Connects segments of one line across gaps of at most wall_gap_m, at most half of which was passed by
// supported readings (`passed`, one per cell: not 0). Occupied cells on no line that has a segment of at
// least wall_length_m, and those on one that do not make up a segment, become free.
void connect_walls(GridMap& map, std::span<const std::uint8_t> passed, const TbfOptions& options);

}  // namespace landfall::internal
