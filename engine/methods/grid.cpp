// Occupancy-grid matching: Courcelle & Horn 1999, "Static localization of a wheelchair". A local occupancy
// grid made from one scan is laid over the global grid at every pose of the prior; the largest sum of
// products wins.
//
// Beyond the paper: beams without half-angle are rays (lasers), poses are those of any prior, sums are
// integers (an arc weighs 2^14 instead of 1), all poses near the best score are answered, not it alone, and
// `grid` takes of these the one whose ranges the map gives best (range_posterior.hpp).
#include "engine/methods/grid/block_bounds.hpp"
#include "engine/methods/grid/level.hpp"
#include "engine/methods/grid/reduced.hpp"
#include "engine/methods/table.hpp"

namespace landfall::internal {
namespace {

// With fewer, the bounds cost more than they save (bench/RESULTS.md).
constexpr std::int64_t fewest_bounded_poses = 4'000'000;

Proposal propose(const Query& query, Contours contours, LocalGrids local_grids, Scores scores) {
  const LocalModel model = make_local_model(query.scan, query.lattice, query.options.robot_radius_m);
  LevelScores level = score_level({.query = query,
                                   .lattice = query.lattice,
                                   .mask_of_heading = query.domain.mask_of_heading,
                                   .global = query.map.global_grid(contours),
                                   .model = model,
                                   .rival_share = grid_rival_share,
                                   .local_grids = local_grids});
  Proposal proposal;
  proposal.candidates = std::move(level.rivals);
  proposal.proven = !level.cut_short;
  proposal.counts.poses_scored = level.poses_scored;
  proposal.scores = scores;
  proposal.way = "all poses";
  return proposal;
}

// The same candidates: what the reduced grids find is a score that the best one reaches at least, and blocks
// of poses that cannot come near it are left out.
Proposal propose_within_bounds(const Query& query) {
  Proposal proposal = propose_by_reduction(query);
  const std::int32_t known = proposal.candidates.empty() ? 0 : proposal.candidates.front().score;
  const LocalModel model = make_local_model(query.scan, query.lattice, query.options.robot_radius_m);
  GridLevel level{.query = query,
                  .lattice = query.lattice,
                  .mask_of_heading = query.domain.mask_of_heading,
                  .global = query.map.global_grid(Contours::corrected),
                  .model = model,
                  .rival_share = grid_rival_share};
  const BoundedPoses bounded = poses_within_bounds(level, lowest_rival(known, rival_margin(level)));
  LevelScores within = score_level({.query = query,
                                    .lattice = query.lattice,
                                    .mask_of_heading = bounded.mask_of_heading,
                                    .global = level.global,
                                    .model = model,
                                    .rival_share = grid_rival_share});
  proposal.candidates = std::move(within.rivals);
  proposal.proven = !bounded.cut_short && !within.cut_short;
  proposal.counts.poses_scored += within.poses_scored;
  proposal.counts.bounds_computed = bounded.bounds_computed;
  proposal.way = "bounds";
  return proposal;
}

}  // namespace

Proposal propose_grid(const Query& query) {
  if (query.domain.poses >= fewest_bounded_poses) return propose_within_bounds(query);
  return propose(query, Contours::corrected, LocalGrids::oriented, Scores::own);
}
Proposal propose_grid_published(const Query& query) {
  return propose(query, Contours::corrected, LocalGrids::oriented, Scores::own_decide);
}
Proposal propose_grid_reduced(const Query& query) {
  return propose_by_reduction(query);
}
Proposal propose_grid_uncorrected(const Query& query) {
  return propose(query, Contours::uncorrected, LocalGrids::oriented, Scores::own_decide);
}
Proposal propose_grid_turned(const Query& query) {
  return propose(query, Contours::corrected, LocalGrids::turned, Scores::own_decide);
}

}  // namespace landfall::internal
