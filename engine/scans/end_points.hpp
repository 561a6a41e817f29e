// A scan as the field methods see it: the end points of its echoes, in cells.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/priors/lattice.hpp"
#include "landfall/scan.hpp"

namespace landfall::internal {

// Farther than any map is wide: such a point scores nothing anywhere, and is left out.
inline constexpr double farthest_cells = 1 << 20;

// In the robot's frame. The order is shuffled (the same way for equal numbers), so that any first few
// stand for all; the beams' own order, in which neighbours end close to each other, is kept beside it.
struct EndPoints {
  std::vector<double> x_cells;
  std::vector<double> y_cells;
  std::vector<double> x_cells_by_beam;
  std::vector<double> y_cells_by_beam;

  [[nodiscard]] std::size_t size() const { return x_cells.size(); }
};

EndPoints make_end_points(const Scan& scan, double resolution_m);

// Offsets from the robot's cell to each end point's cell at lattice heading k.
struct HeadingCells {
  std::vector<std::int32_t> col;
  std::vector<std::int32_t> row;
};
void cells_at_heading(const EndPoints& points, const Lattice& lattice, int heading, HeadingCells& cells);
// Into arrays of points.size().
void cells_at_heading(const EndPoints& points, const Lattice& lattice, int heading, std::int32_t* col,
                      std::int32_t* row);

}  // namespace landfall::internal
