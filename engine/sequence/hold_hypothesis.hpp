// Where a scan fits the map and odometry best together.
#pragma once

#include <optional>

#include "engine/sequence/odometry.hpp"
#include "landfall/search.hpp"

namespace landfall::internal {

// The most probable pose near the expected one, by the scan's evidence and odometry's Gaussian: the best
// score alone may stand anywhere within odometry's uncertainty, along a corridor that says little of where.
// A composite's scans settle on the map meanwhile. Score and covariance are those of the lattice's pose
// there. None where that pose is off the map or not free, or no echo falls near a wall.
std::optional<Hypothesis> hold_hypothesis(const PreparedMap& map, const Scan& scan,
                                          const Pose2& T_map_expected, const OdometrySigma& sigma,
                                          const SearchOptions& options);

}  // namespace landfall::internal
