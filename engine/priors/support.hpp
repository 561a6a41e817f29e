// The support of one plain prior (no mixture) on the lattice.
#pragma once

#include "engine/priors/domain.hpp"

namespace landfall::internal {

// Weight 1. A support too thin to hold a lattice pose holds the nearest one. Sets `on_map` where the
// support touches the map, free or not.
DomainComponent make_support(const PosePrior& prior, const Lattice& lattice, const SharedMask& free,
                             bool& on_map);

std::int64_t count_poses(const std::vector<SharedMask>& mask_of_heading);

}  // namespace landfall::internal
