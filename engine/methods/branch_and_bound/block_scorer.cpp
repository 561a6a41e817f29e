#include "engine/methods/branch_and_bound/block_scorer.hpp"

#include <algorithm>
#include <bit>

namespace landfall::internal {

using kernels::block_cells;

namespace {

int row_of(const Node& node, int block) {
  return node.row + block / kernels::tile_cols;
}
int col_of(const Node& node, int block) {
  return node.col + block % kernels::tile_cols;
}

}  // namespace

void BlockScorer::visit(const Node& node, int first_heading, int last_heading, int but) {
  const std::uint64_t blocks = kernels::row_by_row(node.lanes);
  for (int heading = first_heading; heading < last_heading; ++heading) {
    const BlockMask* mask = mask_at(heading);
    if (mask != nullptr && heading != but) visit_blocks(node, blocks, heading, *mask);
  }
}

void BlockScorer::dive(const Node& node, int heading) {
  const BlockMask* mask = mask_at(heading);
  if (mask == nullptr) return;
  const std::uint64_t reaching = bound_blocks(node, kernels::row_by_row(node.lanes), heading);
  if (reaching == 0) return;
  const int best = best_of(reaching);
  score(row_of(node, best), col_of(node, best), heading, *mask, search_.lowest());
}

std::uint64_t BlockScorer::bound_blocks(const Node& node, std::uint64_t blocks, int heading) {
  bounds_computed += std::popcount(blocks);
  return kernels::bound_windows(search_.maxima, node.col * block_cells, node.row * block_cells,
                                search_.points->at(heading), kernels::window_units(search_.lowest()), blocks,
                                bounds_.data());
}

int BlockScorer::best_of(std::uint64_t blocks) const {
  int best = std::countr_zero(blocks);
  for (; blocks != 0; blocks &= blocks - 1) {
    const int block = std::countr_zero(blocks);
    if (bounds_[static_cast<std::size_t>(block)] > bounds_[static_cast<std::size_t>(best)]) best = block;
  }
  return best;
}

// A single block is scored as fast as it is bounded. Of several the best comes first, whose score may exclude
// the others.
void BlockScorer::visit_blocks(const Node& node, std::uint64_t blocks, int heading, const BlockMask& mask) {
  const auto visit = [&](int block, std::int32_t lowest) {
    score(row_of(node, block), col_of(node, block), heading, mask, lowest);
  };
  if (std::has_single_bit(blocks)) return visit(std::countr_zero(blocks), search_.lowest());
  std::uint64_t reaching = bound_blocks(node, blocks, heading);
  if (reaching == 0) return;
  const int best = best_of(reaching);
  visit(best, search_.lowest());
  reaching &= ~(std::uint64_t{1} << best);
  for (; reaching != 0; reaching &= reaching - 1) {
    const int block = std::countr_zero(reaching);
    const std::int32_t lowest = search_.lowest();
    if (bounds_[static_cast<std::size_t>(block)] >= kernels::window_units(lowest)) visit(block, lowest);
  }
}

void BlockScorer::bound(const Node& node, int heading) {
  const BlockMask* mask = mask_at(heading);
  if (mask == nullptr) return;
  std::uint64_t reaching = bound_blocks(node, kernels::row_by_row(node.lanes), heading);
  if (reaching == 0) return;
  best_bound_ = std::max(best_bound_, bounds_[static_cast<std::size_t>(best_of(reaching))]);
  for (; reaching != 0; reaching &= reaching - 1) {
    const int block = std::countr_zero(reaching);
    const std::int32_t bound = bounds_[static_cast<std::size_t>(block)];
    const std::int32_t lowest = search_.lowest();
    const std::int32_t least = kernels::window_units(lowest);
    if (bound < least) continue;
    if (2 * bound >= least + best_bound_)
      score(row_of(node, block), col_of(node, block), heading, *mask, lowest);
    else
      pending.push_back(
          {.bound = bound, .heading = heading, .row = row_of(node, block), .col = col_of(node, block)});
  }
}

void BlockScorer::score(const PendingBlock& block) {
  const std::int32_t lowest = search_.lowest();
  if (block.bound >= kernels::window_units(lowest))
    score(block.row, block.col, block.heading, *mask_at(block.heading), lowest);
}

void BlockScorer::score(int row, int col, int heading, const BlockMask& mask, std::int32_t lowest) {
  const std::uint64_t allowed = mask.at(col, row);
  if (allowed == 0) return;
  const kernels::TilePoints& points = search_.points->at(heading);
  std::int32_t scores[kernels::block_poses];
  poses_scored += std::popcount(allowed);
  if (!kernels::score_block(search_.planes, col * block_cells, row * block_cells, points.col, points.row,
                            points.count, lowest, scores))
    return;
  const Candidate candidate = best_of_block(scores, allowed, heading, row, col);
  if (candidate.score < lowest) return;
  candidates.push_back(candidate);
  search_.best.raise(candidate.score);
}

}  // namespace landfall::internal
