// A box in the map frame, and the grid of cells that covers it.
#pragma once

#include <limits>
#include <string>

#include "landfall/grid_map.hpp"

namespace landfall::internal {

struct Extent {
  Point2 low{.x_m = std::numeric_limits<double>::infinity(), .y_m = std::numeric_limits<double>::infinity()};
  Point2 high{.x_m = -std::numeric_limits<double>::infinity(),
              .y_m = -std::numeric_limits<double>::infinity()};

  void add(const Point2& p_map);
};

struct ExtentGridOptions {
  double resolution_m = 0.05;
  double margin_m = 0.0;  // around the extent
  Occupancy fill = Occupancy::unknown;
  std::string what = "grid";  // named in errors
};

// Its corner is a multiple of the resolution: grids of parts of one place share their cells.
// Throws Error{invalid_argument}: a resolution or margin out of range; Error{too_large}.
GridMap make_grid(const Extent& extent, const ExtentGridOptions& options);

}  // namespace landfall::internal
