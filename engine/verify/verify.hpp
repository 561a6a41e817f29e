// Simulated ranges against the measured ones.
#pragma once

#include <span>
#include <vector>

#include "engine/maps/prepared_state.hpp"
#include "landfall/scan.hpp"

namespace landfall::internal {

// Shares of a scan's valid beams, and what the explained ones are good for.
struct Verification {
  double explained = 0.0;     // the map says the same
  double blocked = 0.0;       // an echo well before the wall: something stood there that the map lacks
  double seen_through = 0.0;  // an echo well behind the wall: hardly to be had
  double held_m2 = 0.0;       // contour that holds the pose (contour.hpp)
};

// What the map says of a scan from each pose. A beam is explained where the simulated range, or that of
// a neighbouring beam (edges, walls at grazing incidence), is the measured one within the noise and the
// grid; a beam without echo, where nothing is hit within its maximum. Unknown cells are no walls.
std::vector<Verification> verify(const PreparedState& map, const Scan& scan,
                                 std::span<const Pose2> T_map_robot);

}  // namespace landfall::internal
