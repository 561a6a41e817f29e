#include "engine/guess.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace landfall::internal {
namespace {

std::optional<Guess> guess_from(const Scan& before, const SearchResult& answer, const Scan& scan) {
  if (!before.T_odom_robot || !scan.T_odom_robot || answer.hypotheses.empty()) return std::nullopt;
  const Hypothesis& hypothesis = answer.hypotheses.front();
  const Pose2 T_map_robot = hypothesis.T_map_robot * inverse(*before.T_odom_robot) * *scan.T_odom_robot;
  // Odometry may be finite and too far to reckon with.
  if (!std::isfinite(T_map_robot.x_m) || !std::isfinite(T_map_robot.y_m)) return std::nullopt;
  return Guess{.map_index = hypothesis.map_index,
               .T_map_robot = T_map_robot,
               .score_per_echo = static_cast<double>(hypothesis.score) / std::max(1, answer.beams_echo)};
}

}  // namespace

void Answers::give(std::size_t scan, SearchResult result) {
  results_[scan] = std::move(result);
  given_[scan].store(true, std::memory_order_release);
}

std::optional<Guess> Answers::guess(std::size_t scan) const {
  constexpr std::size_t most_steps = 4;
  for (std::size_t steps = 1; steps <= std::min(scan, most_steps); ++steps)
    if (given_[scan - steps].load(std::memory_order_acquire))
      return guess_from(scans_[scan - steps], results_[scan - steps], scans_[scan]);
  return std::nullopt;
}

}  // namespace landfall::internal
