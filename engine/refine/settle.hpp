// A composite's scans, each where it fits the map.
#pragma once

#include <span>
#include <vector>

#include "engine/refine/settle/problem.hpp"
#include "landfall/scan.hpp"

namespace landfall::internal {

// Relative poses are good to centimetres mostly, and now and then one is off by far more: along a corridor
// two scans say nothing of each other, where the map would. From a composite's pose, all its scans are fitted
// to the map at once by Gauss-Newton on their evidence (evidence.hpp), each held to its neighbours by
// scan.parts->noise with a Cauchy density.
//
// T_map_robot of each part, and a second way where it pays to break one step before: what rays say of the two
// must decide, since where a map is off much seems to pay.
std::vector<std::vector<Pose2>> settle(const SettleProblem& problem, const Pose2& T_map_robot);
// From poses of the parts: the best of where several starts (at least one) lead.
std::vector<Pose2> settle(const SettleProblem& problem, std::span<const std::vector<Pose2>> T_map_starts);

// The composite with its scans where they settled: T_map_part as from settle(), seen from the reference.
Scan remount(const Scan& scan, const std::vector<Pose2>& T_map_part);

}  // namespace landfall::internal
