#include <algorithm>
#include <cmath>
#include <string>

#include "engine/evidence.hpp"
#include "engine/odometry.hpp"
#include "landfall/consistent.hpp"
#include "landfall/error.hpp"

namespace landfall {
namespace {

using namespace internal;

constexpr double sigmas = 3.0;

struct Expected {
  Pose2 T_map_robot;
  double translation_m;  // one sigma
  double rotation_rad;
  int map_index;

  [[nodiscard]] bool holds(const Hypothesis& hypothesis) const {
    return hypothesis.map_index == map_index &&
           translation_distance(hypothesis.T_map_robot, T_map_robot) <= sigmas * translation_m &&
           angle_distance(hypothesis.T_map_robot.theta_rad, T_map_robot.theta_rad) <= sigmas * rotation_rad;
  }
  [[nodiscard]] Gaussian prior() const {
    const double square_m2 = translation_m * translation_m;
    return {.T_map_robot = T_map_robot,
            .covariance = {square_m2, 0, 0, 0, square_m2, 0, 0, 0, rotation_rad * rotation_rad}};
  }
};

Expected expect(const Hypothesis& from, const Pose2& T_from_here, const OdometryNoise& noise) {
  const OdometrySigma sigma = odometry_sigma(noise, T_from_here);
  return {.T_map_robot = from.T_map_robot * T_from_here,
          .translation_m = std::hypot(sigma.translation_m, pose_sigma_m),
          .rotation_rad = std::hypot(sigma.rotation_rad, pose_sigma_rad),
          .map_index = from.map_index};
}

}  // namespace

std::vector<Prediction> predict(std::span<const SearchResult> results, std::span<const int> choice,
                                std::span<const Pose2> T_odom_robot, const ConsistentOptions& options) {
  if (results.size() != choice.size() || results.size() != T_odom_robot.size())
    throw Error(ErrorCode::invalid_argument, "predict: " + std::to_string(results.size()) + " results, " +
                                                 std::to_string(choice.size()) + " choices and " +
                                                 std::to_string(T_odom_robot.size()) +
                                                 " odometry poses, expected as many");
  std::vector<Prediction> predictions;
  const auto look = [&](std::size_t from, std::size_t here) {
    if (choice[from] < 0 || results[here].beams_echo == 0) return;
    const Hypothesis& hypothesis = results[from].hypotheses.at(static_cast<std::size_t>(choice[from]));
    const Pose2 T_from_here = inverse(T_odom_robot[from]) * T_odom_robot[here];
    const Expected expected = expect(hypothesis, T_from_here, options.odometry);
    const auto& known = results[here].hypotheses;
    if (std::any_of(known.begin(), known.end(), [&](const Hypothesis& one) { return expected.holds(one); }))
      return;
    predictions.push_back({.index = here, .prior = expected.prior(), .map_index = expected.map_index});
  };
  for (std::size_t i = 0; i < results.size(); ++i) {
    if (i > 0) look(i - 1, i);
    if (i + 1 < results.size()) look(i + 1, i);
  }
  return predictions;
}

void add_predicted(SearchResult& result, const SearchResult& answer, int map_index) {
  constexpr double same_m = 0.1;
  constexpr double same_rad = 0.02;
  if (answer.hypotheses.empty()) return;
  Hypothesis added = answer.hypotheses.front();
  added.map_index = map_index;
  for (const Hypothesis& known : result.hypotheses)
    if (known.map_index == map_index && translation_distance(known.T_map_robot, added.T_map_robot) < same_m &&
        angle_distance(known.T_map_robot.theta_rad, added.T_map_robot.theta_rad) < same_rad)
      return;
  if (!result.hypotheses.empty()) {
    const Hypothesis& best = result.hypotheses.front();
    const auto echoes = static_cast<std::size_t>(std::max(1, result.beams_echo));
    const double less = static_cast<double>(added.score - best.score) / (255.0 * static_cast<double>(echoes));
    added.probability = best.probability * std::exp(std::min(0.0, evidence_nats(echoes) * less));
  }
  result.hypotheses.push_back(added);
}

}  // namespace landfall
