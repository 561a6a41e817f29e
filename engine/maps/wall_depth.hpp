// Echoes from within a wall that a map draws thicker than it is.
#pragma once

#include "landfall/grid_map.hpp"

namespace landfall::internal {

// Whether the stretch from_m..to_m of the ray along T_map_beam's x runs through occupied cells alone and ends
// in one close behind their surface: the map then says "wall" where the echo came from, though ray casting
// stops at the wall's face. Deep inside a solid is no place for an echo.
bool ends_within_wall(const GridMap& grid, const Pose2& T_map_beam, double from_m, double to_m);

}  // namespace landfall::internal
