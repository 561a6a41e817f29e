// Blocks of 8 x 8 poses at one heading, scored by the integer sum. One per thread.
#pragma once

#include <atomic>
#include <cstdint>
#include <vector>

#include "engine/query.hpp"

namespace landfall::internal {

// The best score that any thread has found.
class BestScore {
 public:
  [[nodiscard]] std::int32_t get() const { return best_.load(std::memory_order_relaxed); }
  void raise(std::int32_t score) {
    std::int32_t known = get();
    while (score > known && !best_.compare_exchange_weak(known, score, std::memory_order_relaxed)) {
    }
  }

 private:
  std::atomic<std::int32_t> best_{0};
};

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
  std::vector<std::int32_t> index_;
};

}  // namespace landfall::internal
