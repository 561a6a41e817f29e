#include <atomic>
#include <memory>

#include "engine/base/parallel.hpp"
#include "engine/methods/fft/correlation_search.hpp"
#include "engine/methods/fft/exact_blocks.hpp"

namespace landfall::internal {

Proposal propose_directly(const Query& query) {
  Proposal proposal;
  proposal.way = "direct";
  BestScore best;
  std::vector<std::unique_ptr<ExactBlocks>> workers(
      static_cast<std::size_t>(std::max(1, thread_count(query.threads))));
  std::atomic<int> next{0};
  std::atomic<bool> cut_short{false};
  parallel_for(workers.size(), query.threads, [&](std::size_t i) {
    workers[i] = std::make_unique<ExactBlocks>(query, best);
    HeadingCells points;
    for (int heading = next++; heading < query.lattice.headings; heading = next++) {
      const SharedMask& mask = query.domain.mask_of_heading[static_cast<std::size_t>(heading)];
      if (mask == nullptr) continue;
      cells_at_heading(query.points, query.lattice, heading, points);
      for (int row = mask->first_row; row < mask->first_row + mask->rows; ++row) {
        if (query.out_of_time()) {
          cut_short = true;
          return;
        }
        for (int col = mask->first_col; col < mask->first_col + mask->cols; ++col)
          workers[i]->visit(points, heading, row, col);
      }
      keep_rivals(workers[i]->candidates, query.margin);
    }
  });
  for (const auto& worker : workers) {
    proposal.candidates.insert(proposal.candidates.end(), worker->candidates.begin(),
                               worker->candidates.end());
    proposal.counts.poses_scored += worker->poses_scored;
  }
  keep_rivals(proposal.candidates, query.margin);
  proposal.proven = !cut_short;
  return proposal;
}

}  // namespace landfall::internal
