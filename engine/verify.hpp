// Simulated ranges against the measured ones.
#pragma once

#include <span>
#include <vector>

#include "engine/prepared_state.hpp"
#include "landfall/scan.hpp"

namespace landfall::internal {

// The share of a scan's valid beams that the map explains, from each pose. A beam is explained where the
// simulated range, or that of a neighbouring beam (edges, walls at grazing incidence), is the measured one
// within the noise and the grid; a beam without echo, where nothing is hit within its maximum. Unknown cells
// are no walls.
std::vector<double> explained_shares(const PreparedState& map, const Scan& scan,
                                     std::span<const Pose2> T_map_robot);

}  // namespace landfall::internal
