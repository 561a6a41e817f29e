// The field's score of poses on the lattice, one by one: for methods that do not go over the lattice.
#pragma once

#include <optional>

#include "engine/query.hpp"

namespace landfall::internal {

// The pose of the prior's lattice that scores best beside a pose, at most one step of each kind away; none
// where the prior has none there.
std::optional<Candidate> best_on_lattice_beside(const Query& query, const Pose2& T_map_robot);

}  // namespace landfall::internal
