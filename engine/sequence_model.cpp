#include "engine/sequence_model.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "landfall/error.hpp"

namespace landfall::internal {
namespace {

// Less probable hypotheses are not told apart by their own probability: about as often as this, the map has
// changed where the robot is, and a scan is sure of another place.
constexpr double least_probability = 0.05;

// A jump lands anywhere in the box around all hypotheses, at any heading and on any map.
double log_jump_density(std::span<const SearchResult> results, double jump_probability) {
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
  return std::log(jump_probability) - std::log(area_m2 * 2.0 * std::numbers::pi);
}

}  // namespace

OdometrySigma transition_sigma(const OdometryNoise& noise, const Pose2& T_before_after) {
  const OdometrySigma sigma = odometry_sigma(noise, T_before_after);
  return {.translation_m = std::hypot(sigma.translation_m, pose_sigma_m),
          .rotation_rad = std::hypot(sigma.rotation_rad, pose_sigma_rad)};
}

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

SequenceModel::SequenceModel(std::span<const SearchResult> results, const ConsistentOptions& options)
    : noise_(options.odometry), log_jump_(log_jump_density(results, options.jump_probability)) {}

double SequenceModel::log_emission(const Hypothesis& hypothesis) {
  return std::log(std::max(hypothesis.probability, least_probability));
}

double SequenceModel::log_transition(const Hypothesis& before, const Hypothesis& after,
                                     const Pose2& T_before_after) const {
  if (before.map_index != after.map_index) return log_jump_;
  const OdometrySigma sigma = transition_sigma(noise_, T_before_after);
  const Pose2 T_moved = inverse(before.T_map_robot) * after.T_map_robot;
  const double off = translation_distance(T_moved, T_before_after) / sigma.translation_m;
  const double turned = angle_distance(T_moved.theta_rad, T_before_after.theta_rad) / sigma.rotation_rad;
  const double log_normaliser = 1.5 * std::log(2.0 * std::numbers::pi) + 2.0 * std::log(sigma.translation_m) +
                                std::log(sigma.rotation_rad);
  return std::max(log_jump_, -0.5 * (off * off + turned * turned) - log_normaliser);
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
