// What occupancy-grid matching costs, step by step: search() with method `grid` does more than the paper.
#pragma once

#include "landfall/prepared_map.hpp"
#include "landfall/prior.hpp"
#include "landfall/scan.hpp"
#include "landfall/search.hpp"

namespace landfall::internal {

// Processor time of one thread, milliseconds; medians.
struct GridMatchingTimes {
  double local_grids_ms = 0.0;  // drawing the oriented local grids of all headings
  double matching_ms = 0.0;     // laying them over the global grid at all poses
};

// Of options its steps and the robot's radius count. The map's own parts are built beforehand.
// Throws Error{invalid_argument}: as search() does; repetitions < 1.
GridMatchingTimes time_grid_matching(const PreparedMap& map, const PosePrior& prior, const Scan& scan,
                                     const SearchOptions& options, int repetitions = 1);

}  // namespace landfall::internal
