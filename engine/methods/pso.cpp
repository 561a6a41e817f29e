// Particle swarms (Okada & Fujimoto, Grid-based Localization and Mapping Method without Odometry Information,
// section II.B.2) as a search method: the cost is the share of end points outside of the map's occupied
// cells.
//
// Beyond the paper: a prior larger than the published start pattern is divided among swarms, each of the
// published size and reach, around poses drawn from the prior; the best poses of all swarms are answered. A
// pose is not bound to the lattice: the field scores the lattice pose beside it, the swarm's own count is
// shown.
#include <cmath>

#include "engine/base/parallel.hpp"
#include "engine/methods/free_search.hpp"
#include "engine/methods/pso/swarm.hpp"
#include "engine/methods/table.hpp"

namespace landfall::internal {
namespace {

// Swarms for each part of the prior as large as the start pattern: random parts overlap and leave gaps.
constexpr double swarms_per_reach = 4.0;

}  // namespace

Proposal propose_pso(const Query& query) {
  const SwarmOptions swarm;
  const MapFit fit(query);
  const std::vector<Pose2> centers =
      search_centers(query, {swarm.reach_m, swarm.reach_rad}, swarms_per_reach);
  const std::vector<Eigen::Vector3d> start = start_pattern(swarm);
  std::vector<FreeCandidate> found(centers.size());
  std::vector<std::int64_t> scored(centers.size(), 0);
  (void)query.map.field();
  parallel_for(centers.size(), query.threads, [&](std::size_t i) {
    const auto pose_of = [&](const Eigen::Vector3d& z) {
      return centers[i] * Pose2{.x_m = z[0], .y_m = z[1], .theta_rad = z[2]};
    };
    if (query.out_of_time()) return;
    const Flight flight = fly(
        start, fit.valid(), [&](const Eigen::Vector3d& z) { return fit.at(pose_of(z)); }, swarm,
        {.seed = query.options.seed, .flight = static_cast<std::uint32_t>(i)},
        [&] { return query.out_of_time(); });
    found[i] = {.T_map_robot = pose_of(flight.best), .score = flight.fit};
    scored[i] = flight.poses_scored;
  });
  std::erase_if(found, [](const FreeCandidate& one) { return one.score == 0; });
  Proposal proposal = propose_free(query, std::move(found));
  for (const std::int64_t count : scored) proposal.counts.poses_scored += count;
  return proposal;
}

}  // namespace landfall::internal
