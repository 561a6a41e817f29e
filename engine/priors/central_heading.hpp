#pragma once

#include "engine/priors/lattice.hpp"
#include "landfall/prior.hpp"

namespace landfall::internal {

// The same lattice with one heading on the prior's own; unchanged for priors of any heading, of several poses
// or of several parts.
Lattice centered_on(const PosePrior& prior, Lattice lattice);

}  // namespace landfall::internal
