#include "engine/align/match_step.hpp"

#include <algorithm>
#include <numbers>

#include "engine/align/correlate.hpp"
#include "engine/align/overlap.hpp"
#include "engine/align/refine_jointly.hpp"

namespace landfall::internal {
namespace {

constexpr std::size_t most_matches = 6;
constexpr double distinct_m = 0.1;
constexpr double distinct_rad = std::numbers::pi / 90.0;

}  // namespace

std::vector<StepMatch> match_step(const ScanView& before, const ScanView& after, const OdometryStep& step) {
  struct Scored {
    StepMatch match;
    double log_posterior;
  };
  const ScanView* const pair[2] = {&before, &after};
  const ScanWindow window{.scans = pair, .steps = {&step, 1}, .reference = 0};
  const double nats = overlap_nats(before, after);
  std::vector<Scored> scored;
  for (const Pose2& start : correlate(before, after, step)) {
    const Pose2 T_before_after = refine_jointly(window, {Pose2{}, start}).T_reference_robot[1];
    const double share = overlap_share(before, after, T_before_after);
    const SquaredDeviation off = squared_deviation(step, T_before_after);
    scored.push_back({.match = {.T_before_after = T_before_after, .overlap_share = share},
                      .log_posterior = nats * share - 0.5 * (off.translation + off.rotation)});
  }
  std::stable_sort(scored.begin(), scored.end(),
                   [](const Scored& a, const Scored& b) { return a.log_posterior > b.log_posterior; });
  std::vector<StepMatch> kept;
  for (const Scored& candidate : scored) {
    const Pose2& pose = candidate.match.T_before_after;
    const bool near = std::any_of(kept.begin(), kept.end(), [&](const StepMatch& other) {
      return translation_distance(pose, other.T_before_after) < distinct_m &&
             angle_distance(pose.theta_rad, other.T_before_after.theta_rad) < distinct_rad;
    });
    if (!near) kept.push_back(candidate.match);
    if (kept.size() == most_matches) break;
  }
  return kept;
}

}  // namespace landfall::internal
