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

// Where a result's neighbours and odometry say that the robot must have been, but none of its hypotheses
// is: ask that scan again under `prior` on map `map_index`, and add what comes to its hypotheses.
struct Prediction {
  std::size_t index = 0;  // of the result
  Gaussian prior;
  int map_index = 0;
};
// From each chosen hypothesis to the results before and after it. Same lengths; Error as above.
std::vector<Prediction> predict(std::span<const SearchResult> results, std::span<const int> choice,
                                std::span<const Pose2> T_odom_robot, const ConsistentOptions& options = {});
// Adds the first hypothesis of `answer` (to the same scan, under a prediction) to `result`, with the
// probability that its score deserves beside the best one there. Nothing where it has one nearby.
void add_predicted(SearchResult& result, const SearchResult& answer, int map_index);

}  // namespace landfall
