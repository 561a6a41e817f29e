#include "engine/sequence/sequence_model.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/base/number_text.hpp"
#include "landfall/error.hpp"

namespace landfall::internal {
namespace {

// About as often as this, the map has changed where the robot is, and a scan is sure of another place. What
// less probable hypotheses are told apart by is then worth little: of their nats, a part.
constexpr double least_probability = 0.05;
constexpr double least_slope = 0.1;

// A jump lands anywhere in the box around all hypotheses, at any heading and on any map.
double log_uniform_density(std::span<const SearchResult> results) {
  double x0 = 1e300, x1 = -1e300, y0 = 1e300, y1 = -1e300;
  int last_map = 0;
  for (const SearchResult& result : results) {
    for (const Hypothesis& hypothesis : result.hypotheses) {
      x0 = std::min(x0, hypothesis.T_map_robot.x_m);
      x1 = std::max(x1, hypothesis.T_map_robot.x_m);
      y0 = std::min(y0, hypothesis.T_map_robot.y_m);
      y1 = std::max(y1, hypothesis.T_map_robot.y_m);
      last_map = std::max(last_map, hypothesis.map_index);
    }
  }
  const double area_m2 = std::max(1.0, x1 - x0) * std::max(1.0, y1 - y0) * (last_map + 1);
  return -std::log(area_m2 * 2.0 * std::numbers::pi);
}

}  // namespace

void check_sequence(const std::string& function, std::span<const PreparedMap> maps,
                    std::span<const Scan> scans, std::span<const SearchResult> results) {
  const auto fail = [&](const std::string& message) {
    throw Error(ErrorCode::invalid_argument, function + ": " + message);
  };
  if (results.size() != scans.size())
    fail(std::to_string(results.size()) + " results and " + std::to_string(scans.size()) +
         " scans, expected as many");
  for (std::size_t i = 0; i < scans.size(); ++i) {
    if (!scans[i].T_odom_robot) fail("scan " + std::to_string(i) + " has no T_odom_robot");
    for (const Hypothesis& one : results[i].hypotheses)
      if (one.map_index < 0 || static_cast<std::size_t>(one.map_index) >= maps.size())
        fail("result " + std::to_string(i) + " is on map " + std::to_string(one.map_index) + " of " +
             std::to_string(maps.size()));
  }
}

void check_options(const std::string& function, const ConsistentOptions& options) {
  check_odometry_noise(function, options.odometry);
  if (!(options.jump_probability > 0.0) || !(options.jump_probability <= 1.0))
    throw Error(ErrorCode::invalid_argument, function + ": jump_probability is " +
                                                 number_text(options.jump_probability) +
                                                 ", expected more than 0 and at most 1");
}

SequenceModel::SequenceModel(std::span<const SearchResult> results, std::span<const Pose2> T_odom_robot,
                             const ConsistentOptions& options)
    : noise_(options.odometry) {
  const double log_uniform = log_uniform_density(results);
  log_jump_ = std::log(options.jump_probability) + log_uniform;
  quality_ = judge_odometry(results, T_odom_robot, noise_, std::exp(log_uniform));
}

double SequenceModel::log_emission(const Hypothesis& hypothesis) {
  const double log_probability = std::log(std::max(hypothesis.probability, 1e-300));
  const double log_least = std::log(least_probability);
  if (log_probability > log_least) return log_probability;
  return log_least + least_slope * (log_probability - log_least);
}

double SequenceModel::log_transition(const Hypothesis& before, const Hypothesis& after,
                                     const Pose2& T_before_after) const {
  if (before.map_index != after.map_index) return log_jump_;
  const StepOff off = step_off(before.T_map_robot, after.T_map_robot, T_before_after);
  return std::max(log_jump_, log_step_density(noise_, quality_, T_before_after, off));
}

OdometrySigma SequenceModel::transition_sigma(const Pose2& T_before_after) const {
  return with_pose_sigma(odometry_sigma(noise_, T_before_after), quality_);
}

SequenceModel::Extended SequenceModel::extend(std::span<const Hypothesis> before,
                                              std::span<const double> log_posterior,
                                              std::span<const Hypothesis> after,
                                              const Pose2& T_before_after) const {
  Extended next;
  for (const Hypothesis& here : after) {
    double best = -1e300;
    int from = -1;
    for (std::size_t b = 0; b < before.size(); ++b) {
      const double through = log_posterior[b] + log_transition(before[b], here, T_before_after);
      if (through <= best) continue;
      best = through;
      from = static_cast<int>(b);
    }
    next.log_posterior.push_back(log_emission(here) + (before.empty() ? 0.0 : best));
    next.came_from.push_back(from);
  }
  return next;
}

}  // namespace landfall::internal
