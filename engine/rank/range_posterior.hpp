// The posterior of a method whose scores are its own: what its best poses share of the prior, by their
// ranges.
//
// Such a score proposes poses; it is no likelihood. The ranges are: the beam model at the best poses of the
// lattice, then, where that is likely, at eight poses within each one's cell of the lattice.
#pragma once

#include "engine/rank/rank.hpp"

namespace landfall::internal {

// Modes by their posterior mass, best first: at most `most`. A mode stands where the most mass lies within a
// step of the lattice; what lies within the distinct distances of it is its own, and no later mode's.
Modes find_modes_by_ranges(const Query& query, const Proposal& proposal, std::size_t most);

}  // namespace landfall::internal
