#include "engine/align/match_step.hpp"

#include <algorithm>
#include <numbers>

#include "engine/align/correlate.hpp"
#include "engine/align/overlap.hpp"
#include "engine/align/refine_jointly.hpp"

namespace landfall::internal {
namespace {

constexpr std::size_t most_matches = 8;
constexpr double distinct_m = 0.1;
constexpr double distinct_rad = std::numbers::pi / 90.0;
// Where surfaces hold a scan loosely, good odometry puts it elsewhere than bad odometry does.
constexpr double good_odometry = 0.25;  // of the stated sigmas

OdometryStep scaled(OdometryStep step, double factor) {
  step.sigma.translation_m *= factor;
  step.sigma.rotation_rad *= factor;
  return step;
}

class StepMatcher {
 public:
  StepMatcher(const ScanView& before, const ScanView& after, const OdometryStep& step)
      : pair_{&before, &after}, step_(step), nats_(overlap_nats(before, after)) {}

  StepMatch add_refined(const Pose2& start, const OdometryStep& step) {
    const ScanWindow window{.scans = pair_, .steps = {&step, 1}, .reference = 0};
    const Pose2 T_before_after = refine_jointly(window, {Pose2{}, start}).T_reference_robot[1];
    const double share = overlap_share(*pair_[0], *pair_[1], T_before_after);
    const SquaredDeviation off = squared_deviation(step_, T_before_after);
    scored_.push_back({.match = {.T_before_after = T_before_after, .overlap_share = share},
                       .log_posterior = nats_ * share - 0.5 * (off.translation + off.rotation)});
    return scored_.back().match;
  }

  // `always` is one of them however badly it fits.
  [[nodiscard]] std::vector<StepMatch> best_and(const StepMatch& always) {
    std::stable_sort(scored_.begin(), scored_.end(),
                     [](const Scored& a, const Scored& b) { return a.log_posterior > b.log_posterior; });
    std::vector<StepMatch> kept;
    for (const Scored& candidate : scored_) {
      if (!is_near_any(candidate.match.T_before_after, kept)) kept.push_back(candidate.match);
      if (kept.size() + 1 == most_matches) break;
    }
    if (!is_near_any(always.T_before_after, kept)) kept.push_back(always);
    return kept;
  }

 private:
  struct Scored {
    StepMatch match;
    double log_posterior;
  };

  static bool is_near_any(const Pose2& pose, const std::vector<StepMatch>& kept) {
    return std::any_of(kept.begin(), kept.end(), [&](const StepMatch& other) {
      return translation_distance(pose, other.T_before_after) < distinct_m &&
             angle_distance(pose.theta_rad, other.T_before_after.theta_rad) < distinct_rad;
    });
  }

  const ScanView* pair_[2];
  const OdometryStep& step_;
  double nats_;
  std::vector<Scored> scored_;
};

}  // namespace

std::vector<StepMatch> match_step(const ScanView& before, const ScanView& after, const OdometryStep& step) {
  const std::vector<Pose2> starts = correlate(before, after, step);
  if (starts.empty()) return {};
  StepMatcher matcher(before, after, step);
  const OdometryStep good = scaled(step, good_odometry);
  for (const Pose2& start : starts)
    matcher.add_refined(matcher.add_refined(start, step).T_before_after, good);
  return matcher.best_and(matcher.add_refined(step.T_before_after, good));
}

}  // namespace landfall::internal
