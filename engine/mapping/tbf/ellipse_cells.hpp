// The cells of a point's error ellipse, and the point's density there.
// Ivanjko, Petrovic & Miklic 2005, equation 5.
#pragma once

#include <cstddef>
#include <vector>

#include "engine/mapping/tbf/symmetric2.hpp"
#include "landfall/grid_map.hpp"

namespace landfall::internal {

struct CellDensity {
  std::size_t index = 0;
  double density = 0.0;  // f, 1 / m^2
};

// E, three standard deviations around the point: the cells whose centres lie within, and f there. f is as
// printed, over sqrt(2 pi det P), where a normal density would have 2 pi sqrt(det P): a factor for A.
// Changed: P is P_T widened by a cell's own variance, resolution^2 / 12 in each direction. A point that is
// known better than that would else fall between the centres of cells. The grid's axes are the map's. `cells`
// is overwritten.
void ellipse_cells(const GridMap& grid, const Point2& p_map, const Symmetric2& covariance_m2,
                   std::vector<CellDensity>& cells);

}  // namespace landfall::internal
