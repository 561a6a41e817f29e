#include "engine/methods/block_scorer.hpp"

#include <algorithm>
#include <bit>

namespace landfall::internal {

using kernels::block_cells;

void BlockScorer::visit(int first_heading, int last_heading, int block_row, int block_col) {
  for (int heading = first_heading; heading < last_heading; ++heading) {
    const SharedMask& mask = search_.query.domain.mask_of_heading[static_cast<std::size_t>(heading)];
    const std::uint64_t allowed = mask == nullptr ? 0 : mask->at(block_col, block_row);
    if (allowed != 0) visit(heading, allowed, block_row, block_col);
  }
}

// Indices and bound a part of the points at a time: most blocks are excluded by the first.
std::int32_t BlockScorer::bound(const HeadingCells& cells, int block_row, int block_col,
                                std::int32_t lowest) {
  constexpr std::size_t points_at_a_time = 64;
  const std::size_t points = index_.size();
  std::int64_t sum = 0;
  for (std::size_t first = 0; first < points; first += points_at_a_time) {
    const std::size_t count = std::min(points_at_a_time, points - first);
    kernels::window_indices(search_.planes, block_col * block_cells, block_row * block_cells,
                            cells.col.data() + first, cells.row.data() + first, count, index_.data() + first);
    sum += kernels::bound_block(search_.planes, index_.data() + first, count, 0);
    const std::int64_t most = sum + 255 * static_cast<std::int64_t>(points - first - count);
    if (most < lowest) return static_cast<std::int32_t>(most);
  }
  return static_cast<std::int32_t>(sum);
}

void BlockScorer::visit(int heading, std::uint64_t allowed, int block_row, int block_col) {
  const HeadingCells& cells = search_.heading_cells->at(heading);
  const std::int32_t lowest = search_.lowest();
  ++bounds_computed;
  if (bound(cells, block_row, block_col, lowest) < lowest) return;
  std::int32_t scores[kernels::block_poses];
  poses_scored += std::popcount(allowed);
  if (!kernels::score_block(search_.planes, index_.data(), index_.size(), lowest, scores)) return;
  const Candidate candidate = best_of_block(scores, allowed, heading, block_row, block_col);
  if (candidate.score < lowest) return;
  candidates.push_back(candidate);
  search_.best.raise(candidate.score);
}

}  // namespace landfall::internal
