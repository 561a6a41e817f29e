#include "engine/sequence/odometry_quality.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace landfall::internal {
namespace {

// Factors of odometry's sigmas, evenly spaced in their logarithm.
constexpr double least_factor = 0.1;
constexpr double largest_factor = 1.6;
constexpr int factors = 9;
constexpr double factor_sigma_nats = 1.0;  // of what is expected beforehand
constexpr double slip_share = 0.05;
// That neither of two neighbours lists the right place, at least.
constexpr double least_neither = 0.02;
// Steps farther off are not odometry's at any factor.
constexpr double farthest_sigmas = 6.0;

double factor(int i) {
  return least_factor * std::pow(largest_factor / least_factor, i / (factors - 1.0));
}

double density(const OdometrySigma& sigma, const StepOff& off) {
  const double t = off.translation_m / sigma.translation_m;
  const double r = off.rotation_rad / sigma.rotation_rad;
  const double volume =
      std::pow(2.0 * std::numbers::pi, 1.5) * sigma.translation_m * sigma.translation_m * sigma.rotation_rad;
  return std::exp(-0.5 * (t * t + r * r)) / volume;
}

double step_density(const OdometrySigma& sigma, const OdometryQuality& quality, const StepOff& off) {
  return (1.0 - slip_share) * density(with_pose_sigma(sigma, quality), off) +
         slip_share * density(with_pose_sigma(sigma, {}), off);
}

struct WeighedStep {
  StepOff off;
  double probability;
};

// Two neighbours: the steps between their hypotheses that may be odometry's.
struct Neighbours {
  OdometrySigma sigma;
  std::vector<WeighedStep> steps{};
  double neither = 1.0;  // probability
};

Neighbours neighbours(const SearchResult& before, const SearchResult& after, const Pose2& T_before_after,
                      const OdometryNoise& noise) {
  Neighbours pair{.sigma = odometry_sigma(noise, T_before_after)};
  const OdometrySigma widest = with_pose_sigma(pair.sigma, {largest_factor, largest_factor});
  double any = 0.0;
  for (const Hypothesis& b : before.hypotheses) {
    for (const Hypothesis& a : after.hypotheses) {
      const double probability = b.probability * a.probability;
      any += probability;
      if (a.map_index != b.map_index) continue;
      const StepOff off = step_off(b.T_map_robot, a.T_map_robot, T_before_after);
      if (off.translation_m < farthest_sigmas * widest.translation_m &&
          off.rotation_rad < farthest_sigmas * widest.rotation_rad)
        pair.steps.push_back({off, probability});
    }
  }
  pair.neither = std::max(least_neither, 1.0 - any);
  return pair;
}

double log_posterior(const std::vector<Neighbours>& pairs, const OdometryQuality& quality,
                     double uniform_density) {
  const double t = std::log(quality.translation_factor) / factor_sigma_nats;
  const double r = std::log(quality.rotation_factor) / factor_sigma_nats;
  double sum = -0.5 * (t * t + r * r);
  for (const Neighbours& pair : pairs) {
    double likelihood = pair.neither * uniform_density;
    for (const WeighedStep& step : pair.steps)
      likelihood += step.probability * step_density(pair.sigma, quality, step.off);
    sum += std::log(likelihood);
  }
  return sum;
}

}  // namespace

OdometrySigma with_pose_sigma(const OdometrySigma& sigma, const OdometryQuality& quality) {
  return {.translation_m = std::hypot(quality.translation_factor * sigma.translation_m, pose_sigma_m),
          .rotation_rad = std::hypot(quality.rotation_factor * sigma.rotation_rad, pose_sigma_rad)};
}

double log_step_density(const OdometryNoise& noise, const OdometryQuality& quality,
                        const Pose2& T_before_after, const StepOff& off) {
  return std::log(std::max(1e-300, step_density(odometry_sigma(noise, T_before_after), quality, off)));
}

OdometryQuality judge_odometry(std::span<const SearchResult> results, std::span<const Pose2> T_odom_robot,
                               const OdometryNoise& noise, double uniform_density) {
  std::vector<Neighbours> pairs;
  for (std::size_t i = 0; i + 1 < results.size(); ++i) {
    Neighbours pair =
        neighbours(results[i], results[i + 1], inverse(T_odom_robot[i]) * T_odom_robot[i + 1], noise);
    if (!pair.steps.empty()) pairs.push_back(std::move(pair));
  }
  OdometryQuality best;
  double best_log_posterior = log_posterior(pairs, best, uniform_density);
  for (int t = 0; t < factors; ++t) {
    for (int r = 0; r < factors; ++r) {
      const OdometryQuality quality{.translation_factor = factor(t), .rotation_factor = factor(r)};
      const double here = log_posterior(pairs, quality, uniform_density);
      if (here <= best_log_posterior) continue;
      best_log_posterior = here;
      best = quality;
    }
  }
  return best;
}

}  // namespace landfall::internal
