// Floor plans: straight walls in metres. Either kind of map can be made from the other.
#pragma once

#include <vector>

#include "landfall/grid_map.hpp"
#include "landfall/pose2.hpp"

namespace landfall {

struct Wall {
  Point2 a_map;
  Point2 b_map;
  friend bool operator==(const Wall&, const Wall&) = default;
};

struct WallMap {
  std::vector<Wall> walls{};
  friend bool operator==(const WallMap&, const WallMap&) = default;
};

// Throws Error{invalid_argument}: no walls, or a coordinate that is not finite.
void validate(const WallMap& map);

// The faces between occupied and other cells, collinear neighbours merged; in the map frame.
// Exact: a ray meets a wall of the result where it would enter an occupied cell.
WallMap to_walls(const GridMap& map);

// Occupied where a wall passes through a cell (every cell it touches), free elsewhere within the
// walls' bounding box, which is widened by `margin_m` (there too: free). Cells outside the building
// become unknown where `outside_unknown`: those reachable from the border without crossing a wall.
struct GridFromWallsOptions {
  double resolution_m = 0.05;
  double margin_m = 0.5;
  bool outside_unknown = false;
};
GridMap to_grid(const WallMap& map, const GridFromWallsOptions& options = {});

}  // namespace landfall
