#include "landfall/consistent.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "engine/odometry.hpp"
#include "landfall/error.hpp"

namespace landfall {
namespace {

using internal::odometry_sigma;
using internal::OdometrySigma;
using internal::pose_sigma_m;
using internal::pose_sigma_rad;

// Less probable hypotheses are not told apart by their own probability.
constexpr double least_probability = 1e-4;

struct Step {
  Pose2 T_before_after;  // odometry
  OdometrySigma sigma;
};

// Log density of moving between two hypotheses: odometry's Gaussian, or a jump to anywhere.
double log_transition(const Hypothesis& before, const Hypothesis& after, const Step& step, double log_jump) {
  const Pose2 T_moved = inverse(before.T_map_robot) * after.T_map_robot;
  const double translation_m = std::hypot(step.sigma.translation_m, pose_sigma_m);
  const double rotation_rad = std::hypot(step.sigma.rotation_rad, pose_sigma_rad);
  const double off = translation_distance(T_moved, step.T_before_after) / translation_m;
  const double turned = angle_distance(T_moved.theta_rad, step.T_before_after.theta_rad) / rotation_rad;
  const double log_normaliser =
      1.5 * std::log(2.0 * std::numbers::pi) + 2.0 * std::log(translation_m) + std::log(rotation_rad);
  return std::max(log_jump, -0.5 * (off * off + turned * turned) - log_normaliser);
}

double log_emission(const Hypothesis& hypothesis) {
  return std::log(std::max(hypothesis.probability, least_probability));
}

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

std::vector<int> consistent(std::span<const SearchResult> results, std::span<const Pose2> T_odom_robot,
                            const ConsistentOptions& options) {
  if (results.size() != T_odom_robot.size())
    throw Error(ErrorCode::invalid_argument, "consistent: " + std::to_string(results.size()) +
                                                 " results and " + std::to_string(T_odom_robot.size()) +
                                                 " odometry poses, expected as many");
  if (!(options.jump_probability > 0.0) || !(options.jump_probability <= 1.0))
    throw Error(ErrorCode::invalid_argument, "consistent: jump_probability is " +
                                                 std::to_string(options.jump_probability) +
                                                 ", expected more than 0 and at most 1");
  std::vector<std::size_t> answered;
  for (std::size_t i = 0; i < results.size(); ++i)
    if (!results[i].hypotheses.empty()) answered.push_back(i);
  std::vector<int> choice(results.size(), -1);
  if (answered.empty()) return choice;
  const double log_jump = log_jump_density(results, options.jump_probability);

  std::vector<std::vector<int>> came_from(answered.size());
  std::vector<double> score;
  for (std::size_t a = 0; a < answered.size(); ++a) {
    const auto& here = results[answered[a]].hypotheses;
    std::vector<double> next(here.size());
    came_from[a].assign(here.size(), -1);
    for (std::size_t h = 0; h < here.size(); ++h) next[h] = log_emission(here[h]);
    if (a > 0) {
      const std::size_t previous = answered[a - 1];
      const auto& before = results[previous].hypotheses;
      const Pose2 T_before_after = inverse(T_odom_robot[previous]) * T_odom_robot[answered[a]];
      const Step step{T_before_after, odometry_sigma(options.odometry, T_before_after)};
      for (std::size_t h = 0; h < here.size(); ++h) {
        double best = -1e300;
        for (std::size_t p = 0; p < before.size(); ++p) {
          const bool same_map = before[p].map_index == here[h].map_index;
          const double through =
              score[p] + (same_map ? log_transition(before[p], here[h], step, log_jump) : log_jump);
          if (through <= best) continue;
          best = through;
          came_from[a][h] = static_cast<int>(p);
        }
        next[h] += best;
      }
    }
    score = std::move(next);
  }
  auto at = static_cast<int>(std::max_element(score.begin(), score.end()) - score.begin());
  for (std::size_t a = answered.size(); a-- > 0;) {
    choice[answered[a]] = at;
    at = came_from[a][static_cast<std::size_t>(at)];
  }
  return choice;
}

}  // namespace landfall
