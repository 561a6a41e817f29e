// Blocks of 8 x 8 poses at one heading, scored by the integer sum. One per thread.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/methods/branch_and_bound/best_score.hpp"
#include "engine/query.hpp"

namespace landfall::internal {

class ExactBlocks {
 public:
  ExactBlocks(const Query& query, BestScore& best);

  // The best allowed pose of a block, where it is a rival of the best one so far. `points` of the heading.
  void visit(const HeadingCells& points, int heading, int block_row, int block_col);

  std::vector<Candidate> candidates;
  std::int64_t poses_scored = 0;

 private:
  const Query& query_;
  BestScore& best_;
  kernels::WindowPlanes planes_;
};

}  // namespace landfall::internal
