#include "engine/align/choose_chain.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/align/overlap.hpp"

namespace landfall::internal {
namespace {

constexpr std::size_t beam_width = 12;

struct Chain {
  std::vector<Pose2> T_first_robot;
  double nats = 0.0;
  SquaredDeviation off;
  double log_posterior = 0.0;
};

// Cauchy, but for a constant.
double log_density(double squared, std::size_t dimensions) {
  return -0.5 * (1.0 + static_cast<double>(dimensions)) * std::log1p(squared);
}

Chain extended(const Chain& chain, const StepMatch& match, const ScanWindow& window) {
  const std::size_t last = chain.T_first_robot.size() - 1;
  const ScanView& after = *window.scans[last + 1];
  Chain longer = chain;
  longer.T_first_robot.push_back(chain.T_first_robot.back() * match.T_before_after);
  longer.nats += overlap_nats(*window.scans[last], after) * match.overlap_share;
  if (last > 0) {
    const Pose2 T_earlier_after = inverse(chain.T_first_robot[last - 1]) * longer.T_first_robot.back();
    const ScanView& earlier = *window.scans[last - 1];
    longer.nats += overlap_nats(earlier, after) * overlap_share(earlier, after, T_earlier_after);
  }
  const SquaredDeviation off = squared_deviation(window.steps[last], match.T_before_after);
  longer.off.translation += off.translation;
  longer.off.rotation += off.rotation;
  const std::size_t steps = last + 1;
  longer.log_posterior =
      longer.nats + log_density(longer.off.translation, 2 * steps) + log_density(longer.off.rotation, steps);
  return longer;
}

}  // namespace

std::vector<Pose2> choose_chain(const ScanWindow& window, std::span<const std::vector<StepMatch>> matches) {
  std::vector<Chain> beam(1);
  beam[0].T_first_robot.emplace_back();
  for (std::size_t k = 0; k < window.steps.size(); ++k) {
    const StepMatch by_odometry{.T_before_after = window.steps[k].T_before_after, .overlap_share = 0.0};
    const std::span<const StepMatch> choices =
        matches[k].empty() ? std::span(&by_odometry, 1) : std::span(matches[k]);
    std::vector<Chain> longer;
    for (const Chain& chain : beam)
      for (const StepMatch& match : choices) longer.push_back(extended(chain, match, window));
    std::stable_sort(longer.begin(), longer.end(),
                     [](const Chain& a, const Chain& b) { return a.log_posterior > b.log_posterior; });
    if (longer.size() > beam_width) longer.resize(beam_width);
    beam = std::move(longer);
  }
  std::vector<Pose2> poses = std::move(beam[0].T_first_robot);
  const Pose2 T_reference_first = inverse(poses[window.reference]);
  for (Pose2& pose : poses) pose = T_reference_first * pose;
  poses[window.reference] = Pose2{};
  return poses;
}

}  // namespace landfall::internal
