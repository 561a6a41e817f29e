#include "engine/methods/fft/exact_blocks.hpp"

#include <bit>

namespace landfall::internal {

using kernels::block_cells;

ExactBlocks::ExactBlocks(const Query& query, BestScore& best)
    : query_(query), best_(best), planes_(query.map.window_tables().planes()) {}

void ExactBlocks::visit(const HeadingCells& points, int heading, int block_row, int block_col) {
  const SharedMask& mask = query_.domain.mask_of_heading[static_cast<std::size_t>(heading)];
  const std::uint64_t allowed = mask == nullptr ? 0 : mask->at(block_col, block_row);
  if (allowed == 0) return;
  const std::int32_t lowest = lowest_rival(best_.get(), query_.margin);
  poses_scored += std::popcount(allowed);
  std::int32_t scores[kernels::block_poses];
  if (!kernels::score_block(planes_, block_col * block_cells, block_row * block_cells, points.col.data(),
                            points.row.data(), points.col.size(), lowest, scores))
    return;
  const Candidate candidate = best_of_block(scores, allowed, heading, block_row, block_col);
  if (candidate.score < lowest) return;
  candidates.push_back(candidate);
  best_.raise(candidate.score);
}

}  // namespace landfall::internal
