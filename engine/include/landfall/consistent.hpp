// A log as a whole: among each scan's hypotheses, those that odometry ties together.
#pragma once

#include <span>
#include <vector>

#include "landfall/align.hpp"
#include "landfall/search.hpp"

namespace landfall {

struct ConsistentOptions {
  // As stated; where the hypotheses of neighbours agree with odometry better or worse, it is taken to be as
  // good as they say, but for a slip now and then.
  OdometryNoise odometry;
  double jump_probability = 1e-6;  // that odometry says nothing between two neighbours (kidnapped)
};

// choice[i]: index into results[i].hypotheses of the most probable sequence (Viterbi), or -1 where
// results[i] has none. T_odom_robot[i] is odometry under results[i]; same length.
// Throws Error{invalid_argument} where the lengths differ, and for options out of range.
std::vector<int> consistent(std::span<const SearchResult> results, std::span<const Pose2> T_odom_robot,
                            const ConsistentOptions& options = {});

// The results with more hypotheses: where a neighbour's probable ones and odometry place the robot, and none
// of the scan's own is near, the scan is asked again there, along the log and back: for what fits best within
// odometry's uncertainty, and for where map and odometry agree best. A scan that fits many places then lists
// the one that its neighbours know. Verdicts stay; what is added comes last.
// results[i] answers scans[i]. Throws Error{invalid_argument} where the lengths differ, a scan has no
// T_odom_robot, or a hypothesis is on a map that is not given, and for options out of range.
std::vector<SearchResult> follow(std::span<const PreparedMap> maps, std::span<const Scan> scans,
                                 std::vector<SearchResult> results, const SearchOptions& search_options = {},
                                 const ConsistentOptions& options = {});

// The results with their chosen hypotheses moved to where each scan and up to two neighbours on either side,
// aligned, fit the map best together: a scan that says little along a corridor stands where its neighbours'
// do. `explained` is that of the new pose; score, covariance and probability stay. choice as from
// consistent(). Composite scans, and those that a jump parts from all others, stay. Throws
// Error{invalid_argument} where follow() does, and for choices of another length or out of range.
std::vector<SearchResult> polish(std::span<const PreparedMap> maps, std::span<const Scan> scans,
                                 std::span<const SearchResult> results, std::span<const int> choice,
                                 const ConsistentOptions& options = {}, int threads = 0);

}  // namespace landfall
