// A log as a whole: among each scan's hypotheses, those that odometry ties together.
#pragma once

#include <span>
#include <vector>

#include "landfall/align.hpp"
#include "landfall/search.hpp"

namespace landfall {

struct ConsistentOptions {
  OdometryNoise odometry;
  double jump_probability = 1e-4;  // that odometry says nothing between two neighbours (kidnapped)
};

// choice[i]: index into results[i].hypotheses of the most probable sequence (Viterbi), or -1 where
// results[i] has none. T_odom_robot[i] is odometry under results[i]; same length.
// Throws Error{invalid_argument} where the lengths differ.
std::vector<int> consistent(std::span<const SearchResult> results, std::span<const Pose2> T_odom_robot,
                            const ConsistentOptions& options = {});

}  // namespace landfall
