// Stochastic diffusion networks: Beattie & Bishop, "Self-localisation in the 'SENARIO' autonomous
// wheelchair", section 2 (the plain network) and 3 (the focused one).
//
// Beyond the paper: modes found are excluded and the network runs again, until none explains as well (4.1,
// symmetry); tolerances, pyramid, cells and limits follow from the scan and the prior (4.2); rays are cast by
// the engine's scene, so that nothing is precomputed per place. Random numbers are keyed by (seed, network of
// the scan, cell, iteration), so that a batch equals the loop over its scans.
#include <utility>
#include <vector>

#include "engine/methods/free_search.hpp"
#include "engine/methods/sdn/find_modes_by_diffusion.hpp"
#include "engine/methods/table.hpp"

namespace landfall::internal {
namespace {

Proposal propose(const Query& query, bool focused) {
  const DiffusionAnswer answer = find_modes_by_diffusion(query, {.focused = focused});
  std::vector<FreeCandidate> found;
  for (const DiffusionMode& mode : answer.modes)
    found.push_back({.T_map_robot = mode.T_map_robot, .score = mode.agreeing});
  Proposal proposal = propose_free(query, std::move(found));
  proposal.counts.poses_scored = answer.counts.draws + answer.counts.copies;
  proposal.counts.rays_cast = answer.counts.tests;
  return proposal;
}

}  // namespace

Proposal propose_sdn(const Query& query) {
  return propose(query, false);
}
Proposal propose_fsdn(const Query& query) {
  return propose(query, true);
}

}  // namespace landfall::internal
