// What is said of a prior that reaches no map: where it is, and where the maps are.
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "landfall/prepared_map.hpp"
#include "landfall/prior.hpp"

namespace landfall::internal {

// "prior 2 lies entirely off the map: it is at (900, 0) m, and the map spans x -12 to 20 m, y -25 to 7 m";
// the number only where several priors are given.
std::string off_map_text(std::span<const PosePrior> priors, std::size_t index,
                         std::span<const PreparedMap> maps);

}  // namespace landfall::internal
