#include "engine/methods/branch_and_bound/heading_groups.hpp"

#include <bit>
#include <cmath>

namespace landfall::internal {

HeadingGroups choose_groups(const EndPoints& points, const Lattice& lattice) {
  constexpr double most_cells = 6.0;
  constexpr int most_headings = 16;
  double mean_cells = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i)
    mean_cells += std::hypot(points.x_cells[i], points.y_cells[i]);
  mean_cells /= static_cast<double>(points.size());
  const double headings = 1.0 + most_cells / std::max(1.0, mean_cells * lattice.heading_step_rad());
  const auto power = std::bit_floor(static_cast<unsigned>(std::min<double>(headings, most_headings)));
  return {.headings = lattice.headings, .per_group = static_cast<int>(power)};
}

}  // namespace landfall::internal
