#include "engine/align/weigh_odometry.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/align/twist.hpp"

namespace landfall::internal {
namespace {

// A match's covariance is wider than its residuals say by this much, and never below this floor.
constexpr double residual_widening = 5.0;
constexpr double floor_m = 0.03;
constexpr double floor_rad = 0.3 * std::numbers::pi / 180.0;
// Of a direction that no match holds: sigmas of 30 m and 30 rad.
constexpr double least_information = 1e-3;

// Factors of odometry's sigmas, evenly spaced in their logarithm.
constexpr double least_factor = 0.1;
constexpr double largest_factor = 1.6;
constexpr int factors = 8;

struct Step {
  Eigen::Vector3d off;  // match less odometry: x, y, heading
  Eigen::Matrix3d match_covariance;
  OdometrySigma sigma;
};

std::vector<Step> steps_of(const ScanWindow& window, const RefinedWindow& matched) {
  Eigen::MatrixXd information = matched.information;
  information.diagonal().array() += least_information;
  hold_scan(window.reference, information);
  Eigen::MatrixXd covariance = residual_widening * information.inverse();
  const auto at = 3 * static_cast<Eigen::Index>(window.reference);
  covariance.block<3, 3>(at, at).setZero();
  std::vector<Step> steps;
  for (std::size_t k = 0; k < window.steps.size(); ++k) {
    const Pose2& before = matched.T_reference_robot[k];
    const Pose2& after = matched.T_reference_robot[k + 1];
    const auto i = 3 * static_cast<Eigen::Index>(k);
    const Eigen::Matrix3d of_motion = covariance.block<3, 3>(i, i) + covariance.block<3, 3>(i + 3, i + 3) -
                                      covariance.block<3, 3>(i, i + 3) - covariance.block<3, 3>(i + 3, i);
    const Eigen::Matrix3d jacobian = relative_jacobian(before, after);
    Step step{.off = difference(inverse(before) * after, window.steps[k].T_before_after),
              .match_covariance = jacobian * of_motion * jacobian.transpose(),
              .sigma = window.steps[k].sigma};
    step.match_covariance.diagonal() +=
        Eigen::Vector3d(floor_m * floor_m, floor_m * floor_m, floor_rad * floor_rad);
    steps.push_back(step);
  }
  return steps;
}

double factor(int i) {
  return least_factor * std::pow(largest_factor / least_factor, i / (factors - 1.0));
}

struct Weighed {
  double log_likelihood = 0.0;         // of the matches, under this odometry
  std::vector<Eigen::Vector3d> off{};  // posterior mean less odometry, step by step
};

Weighed weigh(const std::vector<Step>& steps, double translation_factor, double rotation_factor) {
  Weighed weighed;
  for (const Step& step : steps) {
    const double t = translation_factor * step.sigma.translation_m;
    const double r = rotation_factor * step.sigma.rotation_rad;
    const Eigen::Matrix3d odometry = Eigen::Vector3d(t * t, t * t, r * r).asDiagonal();
    const Eigen::LLT<Eigen::Matrix3d> sum(odometry + step.match_covariance);
    const Eigen::Vector3d gain = sum.solve(step.off);
    const Eigen::Vector3d diagonal = sum.matrixLLT().diagonal();
    weighed.log_likelihood -= diagonal.array().log().sum() + 0.5 * step.off.dot(gain);
    weighed.off.emplace_back(odometry * gain);
  }
  return weighed;
}

// The mean over the factors.
std::vector<Eigen::Vector3d> posterior_mean(const std::vector<Step>& steps) {
  std::vector<Weighed> all;
  double best = -1e300;
  for (int t = 0; t < factors; ++t) {
    for (int r = 0; r < factors; ++r) {
      all.push_back(weigh(steps, factor(t), factor(r)));
      best = std::max(best, all.back().log_likelihood);
    }
  }
  std::vector<Eigen::Vector3d> mean(steps.size(), Eigen::Vector3d::Zero());
  double sum = 0.0;
  for (const Weighed& weighed : all) {
    const double weight = std::exp(weighed.log_likelihood - best);
    sum += weight;
    for (std::size_t k = 0; k < steps.size(); ++k) mean[k] += weight * weighed.off[k];
  }
  for (Eigen::Vector3d& off : mean) off /= sum;
  return mean;
}

}  // namespace

std::vector<Pose2> weigh_odometry(const ScanWindow& window, const RefinedWindow& matched) {
  const std::vector<Eigen::Vector3d> mean = posterior_mean(steps_of(window, matched));
  const auto step = [&](std::size_t k) {
    const Pose2& odometry = window.steps[k].T_before_after;
    return Pose2{.x_m = odometry.x_m + mean[k][0],
                 .y_m = odometry.y_m + mean[k][1],
                 .theta_rad = wrap_angle(odometry.theta_rad + mean[k][2])};
  };
  std::vector<Pose2> poses(window.scans.size());
  for (std::size_t k = window.reference; k < window.steps.size(); ++k) poses[k + 1] = poses[k] * step(k);
  for (std::size_t k = window.reference; k-- > 0;) poses[k] = poses[k + 1] * inverse(step(k));
  return poses;
}

}  // namespace landfall::internal
