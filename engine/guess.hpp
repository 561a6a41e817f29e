// Where a scan was probably taken: odometry leads there from a scan that has been answered. A method may look
// there first, for a good score early spares work. Answers do not depend on it.
#pragma once

#include <atomic>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "landfall/search.hpp"

namespace landfall::internal {

struct Guess {
  int map_index = 0;
  Pose2 T_map_robot;
  double score_per_echo = 0.0;  // the other scan's
};

// The answers of a batch, as threads give them.
class Answers {
 public:
  Answers(std::span<const Scan> scans, std::span<SearchResult> results)
      : scans_(scans), results_(results), given_(scans.size()) {}

  void give(std::size_t scan, SearchResult result);
  // From the first hypothesis of the nearest scan before that has its answer, a few steps back at most:
  // farther, odometry leads nowhere. None where either scan lacks odometry, or nothing was found.
  [[nodiscard]] std::optional<Guess> guess(std::size_t scan) const;

 private:
  std::span<const Scan> scans_;
  std::span<SearchResult> results_;
  std::vector<std::atomic<bool>> given_;
};

}  // namespace landfall::internal
