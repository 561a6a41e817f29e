#include "engine/methods/block_scorer.hpp"

#include <bit>

namespace landfall::internal {

using kernels::block_cells;

void SharedSearch::raise_best(std::int32_t score) {
  std::int32_t known = best.load(std::memory_order_relaxed);
  while (score > known && !best.compare_exchange_weak(known, score, std::memory_order_relaxed)) {
  }
}

void BlockScorer::visit(int first_heading, int last_heading, int block_row, int block_col) {
  for (int heading = first_heading; heading < last_heading; ++heading) {
    const SharedMask& mask = search_.query.domain.mask_of_heading[static_cast<std::size_t>(heading)];
    const std::uint64_t allowed = mask == nullptr ? 0 : mask->at(block_col, block_row);
    if (allowed != 0) visit(heading, allowed, block_row, block_col);
  }
}

void BlockScorer::visit(int heading, std::uint64_t allowed, int block_row, int block_col) {
  const HeadingCells& cells = search_.heading_cells[static_cast<std::size_t>(heading)];
  const std::int32_t lowest = search_.lowest();
  kernels::window_indices(search_.planes, block_col * block_cells, block_row * block_cells, cells.col.data(),
                          cells.row.data(), index_.size(), index_.data());
  ++bounds_computed;
  if (kernels::bound_block(search_.planes, index_.data(), index_.size(), lowest) < lowest) return;
  std::int32_t scores[kernels::block_poses];
  poses_scored += std::popcount(allowed);
  if (!kernels::score_block(search_.planes, index_.data(), index_.size(), lowest, scores)) return;
  const Candidate candidate = best_of_block(scores, allowed, heading, block_row, block_col);
  if (candidate.score < lowest) return;
  candidates.push_back(candidate);
  search_.raise_best(candidate.score);
}

}  // namespace landfall::internal
