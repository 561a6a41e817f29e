#include "engine/methods/block_scorer.hpp"

#include <algorithm>
#include <bit>

namespace landfall::internal {

using kernels::block_cells;

void BlockScorer::visit(const Node& node, int first_heading, int last_heading) {
  const BlockMask* listed = nullptr;
  for (int heading = first_heading; heading < last_heading; ++heading) {
    const BlockMask* mask = search_.query.domain.mask_of_heading[static_cast<std::size_t>(heading)].get();
    if (mask == nullptr) continue;
    if (mask != listed) list_blocks(node, *mask);
    listed = mask;
    if (!blocks_.empty()) visit_blocks(node, heading);
  }
}

void BlockScorer::list_blocks(const Node& node, const BlockMask& mask) {
  blocks_.clear();
  counted_.fill(0);
  for (std::uint64_t lanes = node.lanes; lanes != 0; lanes &= lanes - 1) {
    const int lane = std::countr_zero(lanes);
    const int col = kernels::lane_col(lane);
    const int row = kernels::lane_row(lane);
    const std::uint64_t allowed = mask.at(node.col + col, node.row + row);
    if (allowed == 0) continue;
    const std::size_t bound =
        static_cast<std::size_t>(row) * kernels::tile_cols + static_cast<std::size_t>(col);
    blocks_.push_back({.row = node.row + row, .col = node.col + col, .bound = bound, .allowed = allowed});
    counted_[bound] = 0xFFFF;
  }
}

void BlockScorer::dive(const Node& node, int heading) {
  const SharedMask& mask = search_.query.domain.mask_of_heading[static_cast<std::size_t>(heading)];
  if (mask == nullptr) return;
  list_blocks(node, *mask);
  const HeadingCells& cells = search_.heading_cells->at(heading);
  if (!blocks_.empty() && bound_blocks(node, cells)) score(blocks_.front(), cells, heading, search_.lowest());
}

bool BlockScorer::bound_blocks(const Node& node, const HeadingCells& cells) {
  bounds_computed += static_cast<std::int64_t>(blocks_.size());
  if (!kernels::bound_windows(search_.maxima, node.col * block_cells, node.row * block_cells,
                              cells.col.data(), cells.row.data(), index_.size(), search_.lowest(),
                              counted_.data(), bounds_.data()))
    return false;
  const auto best = std::max_element(blocks_.begin(), blocks_.end(), [&](const Block& a, const Block& b) {
    return bounds_[a.bound] < bounds_[b.bound];
  });
  std::iter_swap(blocks_.begin(), best);
  return true;
}

// A single block is scored as fast as it is bounded. Of several the best comes first, whose score may exclude
// the others.
void BlockScorer::visit_blocks(const Node& node, int heading) {
  const HeadingCells& cells = search_.heading_cells->at(heading);
  if (blocks_.size() == 1) return score(blocks_.front(), cells, heading, search_.lowest());
  if (!bound_blocks(node, cells)) return;
  for (const Block& block : blocks_) {
    const std::int32_t lowest = search_.lowest();
    if (bounds_[block.bound] >= lowest) score(block, cells, heading, lowest);
  }
}

void BlockScorer::score(const Block& block, const HeadingCells& cells, int heading, std::int32_t lowest) {
  std::int32_t scores[kernels::block_poses];
  poses_scored += std::popcount(block.allowed);
  kernels::window_indices(search_.planes, block.col * block_cells, block.row * block_cells, cells.col.data(),
                          cells.row.data(), index_.size(), index_.data());
  if (!kernels::score_block(search_.planes, index_.data(), index_.size(), lowest, scores)) return;
  const Candidate candidate = best_of_block(scores, block.allowed, heading, block.row, block.col);
  if (candidate.score < lowest) return;
  candidates.push_back(candidate);
  search_.best.raise(candidate.score);
}

}  // namespace landfall::internal
