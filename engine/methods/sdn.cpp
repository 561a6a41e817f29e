// Stochastic diffusion networks: Beattie & Bishop, "Self-localisation in the 'SENARIO' autonomous
// wheelchair", section 2 (the plain network) and 3 (the focused one).
//
// Beyond the paper: modes found are excluded and the network runs again, until none explains as well (4.1,
// symmetry); tolerances, pyramid, cells and limits follow from the scan and the prior (4.2); rays are cast by
// the engine's scene, so that nothing is precomputed per place. Random numbers are keyed by (seed, network of
// the scan, cell, iteration), so that a batch equals the loop over its scans.
#include <algorithm>
#include <optional>

#include "engine/methods/sdn/find_modes_by_diffusion.hpp"
#include "engine/methods/table.hpp"

namespace landfall::internal {
namespace {

std::int32_t field_score(const Query& query, const HeadingCells& cells, const LatticePose& pose) {
  const GridMap& grid = query.map.grid();
  const std::vector<std::uint8_t>& field = query.map.field();
  std::int32_t sum = 0;
  for (std::size_t i = 0; i < cells.col.size(); ++i) {
    const CellIndex cell{.col = pose.col + cells.col[i], .row = pose.row + cells.row[i]};
    if (grid.contains(cell)) sum += field[grid.index(cell)];
  }
  return sum;
}

// The pose of the prior's lattice that scores best beside a pose; none where the prior has none there.
std::optional<Candidate> on_lattice(const Query& query, const Pose2& T_map_robot) {
  const LatticePose nearest = query.lattice.nearest(T_map_robot);
  const int step = query.lattice.step_cells;
  const int headings = query.lattice.headings;
  std::optional<Candidate> best;
  HeadingCells cells;
  for (int turn = -1; turn <= 1; ++turn) {
    LatticePose pose{.heading = (nearest.heading + turn + headings) % headings};
    cells_at_heading(query.points, query.lattice, pose.heading, cells);
    for (pose.row = nearest.row - step; pose.row <= nearest.row + step; pose.row += step) {
      for (pose.col = nearest.col - step; pose.col <= nearest.col + step; pose.col += step) {
        if (!query.domain.contains(pose)) continue;
        const Candidate one{.pose = pose, .score = field_score(query, cells, pose)};
        if (!best || better(one, *best)) best = one;
      }
    }
  }
  return best;
}

struct Scored {
  Candidate candidate;
  FreeCandidate free;
};

Proposal propose(const Query& query, bool focused) {
  const DiffusionAnswer answer = find_modes_by_diffusion(query, {.focused = focused});
  std::vector<Scored> scored;
  for (const DiffusionMode& mode : answer.modes)
    if (const auto candidate = on_lattice(query, mode.T_map_robot))
      scored.push_back({*candidate, {.T_map_robot = mode.T_map_robot, .score = mode.agreeing}});
  std::stable_sort(scored.begin(), scored.end(),
                   [](const Scored& a, const Scored& b) { return better(a.candidate, b.candidate); });
  Proposal proposal;
  for (const Scored& one : scored) {
    proposal.candidates.push_back(one.candidate);
    proposal.free_candidates.push_back(one.free);
  }
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
