// Which end points tell most, for the nodes at hand.
#pragma once

#include <vector>

#include "engine/methods/branch_and_bound/block_scorer.hpp"
#include "engine/methods/branch_and_bound/dense_bounds.hpp"

namespace landfall::internal {

// The same points, first those that fall short of a wall most in a sample of the nodes: a bound that adds
// them up excludes most nodes after a few. Without the beams' own order.
EndPoints most_telling_first(const EndPoints& points, SharedSearch& search, const HeadingGroups& groups,
                             const std::vector<Node>& nodes);

}  // namespace landfall::internal
