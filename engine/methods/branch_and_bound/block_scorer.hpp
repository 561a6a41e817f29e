// Blocks of 8 x 8 poses at one heading: bounded a tile at a time, then scored. One per thread.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "engine/methods/branch_and_bound/best_score.hpp"
#include "engine/methods/branch_and_bound/dense_bounds.hpp"
#include "engine/methods/branch_and_bound/points_on_demand.hpp"
#include "engine/query.hpp"

namespace landfall::internal {

// What the threads of one search share.
struct SharedSearch {
  const Query& query;
  kernels::WindowMaxima maxima;
  kernels::WindowPlanes planes;
  std::unique_ptr<PointsOnDemand> points;
  RivalMargin margin{};
  BestScore best{};

  // What a pose must score to be worth looking for.
  [[nodiscard]] std::int32_t lowest() const { return lowest_rival(best.get(), margin); }
};

// A block at one heading that has been bounded and not yet scored.
struct PendingBlock {
  std::int32_t bound;  // in window levels
  std::int32_t heading;
  std::int32_t row;
  std::int32_t col;
};

class BlockScorer {
 public:
  explicit BlockScorer(SharedSearch& search) : search_(search) {}

  // A node's blocks at every heading of [first, last) but one.
  void visit(const Node& node, int first_heading, int last_heading, int but);
  // A node's blocks at one heading, bounded. Of those that may reach the score that matters the most
  // promising are scored, the others wait in `pending`.
  void bound(const Node& node, int heading);
  void score(const PendingBlock& block);
  // Of a node's blocks at one heading that of the best bound alone, for its score.
  void dive(const Node& node, int heading);

  std::vector<PendingBlock> pending;
  std::vector<Candidate> candidates;
  std::int64_t bounds_computed = 0;
  std::int64_t poses_scored = 0;

 private:
  // Blocks of the node at one heading that may reach the score that matters; bits row * tile_cols + col.
  std::uint64_t bound_blocks(const Node& node, std::uint64_t blocks, int heading);
  [[nodiscard]] int best_of(std::uint64_t blocks) const;
  void visit_blocks(const Node& node, std::uint64_t blocks, int heading, const BlockMask& mask);
  void score(int row, int col, int heading, const BlockMask& mask, std::int32_t lowest);
  [[nodiscard]] const BlockMask* mask_at(int heading) const {
    return search_.query.domain.mask_of_heading[static_cast<std::size_t>(heading)].get();
  }

  SharedSearch& search_;
  std::int32_t best_bound_ = 0;                              // of those that bound() has seen
  std::array<std::int32_t, kernels::tile_blocks> bounds_{};  // in window levels
};

}  // namespace landfall::internal
