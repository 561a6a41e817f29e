// Simulated ranges against the measured ones.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/prepared_state.hpp"
#include "landfall/scan.hpp"

namespace landfall::internal {

// Shares of a scan's valid beams.
struct Verification {
  double explained = 0.0;     // the map says the same
  double blocked = 0.0;       // an echo well before the wall: something stood there that the map lacks
  double seen_through = 0.0;  // an echo well behind the wall: hardly to be had
  double log_ranges = 0.0;    // log likelihood of the ranges over that of a perfect fit; see RangeLikelihood
};

// Whether log_ranges is wanted: each range is the simulated one with the sensor's noise and 0.7 cells, one
// sigma (the poses compared are the lattice's), or, one time in five, anything. Summed up over the beams, of
// which at most 20 count as independent, and halved: neighbours err together.
enum class RangeLikelihood : std::uint8_t { left_out, computed };

// What the map says of a scan from each pose. A beam is explained where the simulated range, or that of
// a neighbouring beam (edges, walls at grazing incidence), is the measured one within the noise and the
// grid; a beam without echo, where nothing is hit within its maximum. Unknown cells are no walls.
std::vector<Verification> verify(const PreparedState& map, const Scan& scan,
                                 std::span<const Pose2> T_map_robot,
                                 RangeLikelihood range_likelihood = RangeLikelihood::left_out);

}  // namespace landfall::internal
