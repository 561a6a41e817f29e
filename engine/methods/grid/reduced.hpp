// The reduced grids (Courcelle & Horn 1999, end of section 2): the search is made on coarse grids, and what
// scores best there is looked at on finer ones.
//
// As in the paper, a reduced grid is created at its resolution, not merged from cells of a finer one: local
// grids are drawn from the model in larger cells, and of the global grid the obstacles are drawn in larger
// cells, whose contour is then corrected at that resolution. Merging would put free cells behind occupied
// ones.
#pragma once

#include <vector>

#include "engine/methods/grid/global_grid.hpp"
#include "engine/query.hpp"

namespace landfall::internal {

// The map drawn in cells `factor` times as large: occupied where an obstacle reaches in, else free where any
// of it is, else unknown.
GridMap draw_reduced(const GridMap& map, int factor);

// Cells grow twofold from level to level as long as they are no larger than this; headings that are closer
// than this thin out with them.
inline constexpr double largest_reduced_cell_m = 0.25;
inline constexpr double widest_reduced_heading_step_rad = 0.0873;  // the paper's 5 degrees

// Poses that the full search scores best but that no coarse pose led to are missed: proven is false.
Proposal propose_by_reduction(const Query& query);

}  // namespace landfall::internal
