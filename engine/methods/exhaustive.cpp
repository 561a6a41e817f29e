// Scores every pose of the prior's lattice: the oracle that branch_and_bound is held to.
#include <algorithm>
#include <atomic>

#include "engine/base/parallel.hpp"
#include "engine/methods/table.hpp"
#include "kernels/score_row.hpp"

namespace landfall::internal {
namespace {

using kernels::block_cells;

class HeadingScorer {
 public:
  HeadingScorer(const Query& query, int heading) : query_(query), heading_(heading) {
    cells_at_heading(query.points, query.lattice, heading, cells_);
  }

  // The best allowed pose of each block in a row of blocks.
  void score_blocks(int block_row, const BlockMask& allowed, std::vector<Candidate>& found) {
    const Lattice& lattice = query_.lattice;
    const auto width = static_cast<std::size_t>(lattice.width_cells);
    const int rows = std::min(block_cells, lattice.height_cells - block_row * block_cells);
    scores_.assign(width * block_cells, 0);
    partial_.resize(width);
    for (int row = 0; row < rows; ++row) {
      kernels::score_row(query_.map.field().data(), lattice.width_cells, lattice.height_cells,
                         block_row * block_cells + row, cells_.col.data(), cells_.row.data(),
                         query_.points.size(), partial_.data(),
                         scores_.data() + static_cast<std::size_t>(row) * width);
    }
    for (int col = allowed.first_col; col < allowed.first_col + allowed.cols; ++col) {
      const std::uint64_t word = allowed.at(col, block_row);
      if (word == 0) continue;
      std::int32_t block[kernels::block_poses] = {};
      const int cols = std::min(block_cells, lattice.width_cells - col * block_cells);
      for (int row = 0; row < rows; ++row)
        std::copy_n(scores_.begin() + row * lattice.width_cells + col * block_cells, cols,
                    block + row * block_cells);
      const Candidate best = best_of_block(block, word, heading_, block_row, col);
      if (best.score > 0) found.push_back(best);
    }
  }

 private:
  const Query& query_;
  int heading_;
  HeadingCells cells_;
  std::vector<std::uint16_t> partial_;
  std::vector<std::int32_t> scores_;
};

}  // namespace

Proposal propose_exhaustive(const Query& query) {
  Proposal proposal;
  const auto headings = static_cast<std::size_t>(query.lattice.headings);
  std::vector<std::vector<Candidate>> found(headings);
  std::atomic<bool> cut_short{false};
  std::atomic<std::int64_t> scored{0};
  (void)query.map.field();
  parallel_for(headings, query.threads, [&](std::size_t heading) {
    const SharedMask& allowed = query.domain.mask_of_heading[heading];
    if (allowed == nullptr) return;
    HeadingScorer scorer(query, static_cast<int>(heading));
    for (int row = allowed->first_row; row < allowed->first_row + allowed->rows; ++row) {
      if (query.out_of_time()) {
        cut_short = true;
        return;
      }
      scorer.score_blocks(row, *allowed, found[heading]);
    }
    keep_rivals(found[heading], query.margin);
    scored += allowed->count();
  });
  for (const auto& some : found)
    proposal.candidates.insert(proposal.candidates.end(), some.begin(), some.end());
  keep_rivals(proposal.candidates, query.margin);
  proposal.proven = !cut_short;
  proposal.counts.poses_scored = scored;
  return proposal;
}

}  // namespace landfall::internal
