#include "engine/sequence/odometry_quality.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "engine/base/counter_rng.hpp"

namespace landfall::internal {
namespace {

constexpr double uniform_density = 1e-4;

Hypothesis at(const Pose2& T_map_robot, double probability) {
  Hypothesis hypothesis;
  hypothesis.T_map_robot = T_map_robot;
  hypothesis.probability = probability;
  return hypothesis;
}

// A drive whose odometry errs by the stated noise times a factor.
struct Drive {
  std::vector<SearchResult> results;
  std::vector<Pose2> T_odom_robot;
  CounterRng random;

  Drive(int steps, double factor, std::uint64_t seed) : random(seed) {
    Pose2 T_map_robot;
    Pose2 T_odom{3.0, 4.0, 1.0};
    for (int i = 0; i <= steps; ++i) {
      SearchResult& result = results.emplace_back();
      result.hypotheses = {at(T_map_robot, 0.9), at(Pose2{7.0, 7.0 * (i % 3), 1.0 * i} * T_map_robot, 0.05)};
      T_odom_robot.push_back(T_odom);
      const Pose2 T_step{1.0, 0.0, 0.2};
      const OdometrySigma sigma = odometry_sigma({}, T_step);
      T_map_robot = T_map_robot * T_step;
      T_odom = T_odom * Pose2{T_step.x_m + factor * sigma.translation_m * normal(),
                              T_step.y_m + factor * sigma.translation_m * normal(),
                              T_step.theta_rad + factor * sigma.rotation_rad * normal()};
    }
  }
  double normal() {
    const double radius = std::sqrt(-2.0 * std::log(1.0 - random.uniform()));
    return radius * std::cos(2.0 * std::numbers::pi * random.uniform());
  }
  [[nodiscard]] OdometryQuality judged() const {
    return judge_odometry(results, T_odom_robot, {}, uniform_density);
  }
};

TEST(OdometryQuality, IsLearntFromTheLog) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    SCOPED_TRACE(seed);
    const OdometryQuality good = Drive(60, 0.05, seed).judged();
    EXPECT_LT(good.translation_factor, 0.3);
    EXPECT_LT(good.rotation_factor, 0.3);
    const OdometryQuality as_stated = Drive(60, 1.0, seed).judged();
    EXPECT_GT(as_stated.translation_factor, 0.5);  // hypotheses take 0.1 m of it
    EXPECT_GT(as_stated.rotation_factor, 0.7);
  }
}

TEST(OdometryQuality, IsAsStatedWhereNothingIsKnown) {
  Drive drive(20, 0.0, 1);
  for (std::size_t i = 0; i < drive.results.size(); ++i)
    drive.results[i].hypotheses = {at({100.0 * static_cast<double>(i * i), 0.0, 0.0}, 0.99)};
  EXPECT_EQ(drive.judged().translation_factor, 1.0);
  EXPECT_EQ(drive.judged().rotation_factor, 1.0);
  EXPECT_EQ(judge_odometry({}, {}, {}, uniform_density).translation_factor, 1.0);
}

TEST(OdometryQuality, ASlipIsNotOutOfTheQuestion) {
  const OdometryQuality good{.translation_factor = 0.1, .rotation_factor = 0.1};
  const Pose2 T_step{1.0, 0.0, 0.0};
  const double none = log_step_density({}, good, T_step, {.translation_m = 0.0, .rotation_rad = 0.0});
  const double slip = log_step_density({}, good, T_step, {.translation_m = 0.5, .rotation_rad = 0.0});
  EXPECT_GT(none, log_step_density({}, {}, T_step, {.translation_m = 0.0, .rotation_rad = 0.0}) + 1.0);
  EXPECT_GT(slip, log_step_density({}, {}, T_step, {.translation_m = 0.5, .rotation_rad = 0.0}) - 3.1);
}

}  // namespace
}  // namespace landfall::internal
