#include "landfall/consistent.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "engine/base/counter_rng.hpp"
#include "landfall/error.hpp"

namespace landfall {
namespace {

SearchResult result_of(std::initializer_list<Hypothesis> hypotheses) {
  SearchResult result;
  result.hypotheses = hypotheses;
  return result;
}

Hypothesis at(const Pose2& T_map_robot, double probability, int map_index = 0) {
  Hypothesis hypothesis;
  hypothesis.T_map_robot = T_map_robot;
  hypothesis.probability = probability;
  hypothesis.map_index = map_index;
  return hypothesis;
}

// Odometry's frame is not the map's: here it stands elsewhere and is turned.
Pose2 in_odometry(const Pose2& T_map_robot) {
  return Pose2{-4.0, 9.0, 2.0} * T_map_robot;
}

TEST(Consistent, OdometryChoosesTheSecondBest) {
  const std::vector<SearchResult> results{result_of({at({1.0, 1.0, 0.0}, 0.9)}),
                                          result_of({at({30.0, 5.0, 1.0}, 0.6), at({2.0, 1.0, 0.0}, 0.3)}),
                                          result_of({at({3.0, 1.0, 0.1}, 0.9)})};
  const std::vector<Pose2> T_odom_robot{in_odometry({1.0, 1.0, 0.0}), in_odometry({2.05, 1.0, 0.0}),
                                        in_odometry({3.0, 1.05, 0.1})};
  EXPECT_EQ(consistent(results, T_odom_robot), (std::vector<int>{0, 1, 0}));
}

TEST(Consistent, AWholeLogOutweighsItsFirstScan) {
  // Twin corridors: the log's start prefers the wrong one, all that follows the right one.
  std::vector<SearchResult> results;
  std::vector<Pose2> T_odom_robot;
  for (int i = 0; i < 10; ++i) {
    const Pose2 right{1.0 * i, 0.0, 0.0};
    const Pose2 wrong{1.0 * i, 20.0, 0.0};
    results.push_back(i < 2 ? result_of({at(wrong, 0.7), at(right, 0.3)})
                            : result_of({at(right, 0.6), at(wrong, 0.4)}));
    T_odom_robot.push_back(in_odometry(right));
  }
  EXPECT_EQ(consistent(results, T_odom_robot), (std::vector<int>{1, 1, 0, 0, 0, 0, 0, 0, 0, 0}));
}

TEST(Consistent, AKidnappedRobotJumps) {
  std::vector<SearchResult> results;
  std::vector<Pose2> T_odom_robot;
  for (int i = 0; i < 24; ++i) {
    const Pose2 without_jump{1.0 * i, 0.0, 0.0};
    const Pose2 truth = i < 12 ? without_jump : Pose2{20.0, 50.0, 2.0} * without_jump;
    results.push_back(result_of({at(truth, 0.99), at(without_jump, 0.002)}));
    T_odom_robot.push_back(in_odometry(without_jump));
  }
  EXPECT_EQ(consistent(results, T_odom_robot), (std::vector<int>(24, 0)));
}

TEST(Consistent, ScansWithoutHypothesesAreBridged) {
  const std::vector<SearchResult> results{result_of({}), result_of({at({0.0, 0.0, 0.0}, 0.9)}), result_of({}),
                                          result_of({at({9.0, 9.0, 0.0}, 0.5), at({2.0, 0.0, 0.0}, 0.4)})};
  const std::vector<Pose2> T_odom_robot{{-1, 0, 0}, {0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  EXPECT_EQ(consistent(results, T_odom_robot), (std::vector<int>{-1, 0, -1, 1}));
  EXPECT_EQ(consistent(std::vector<SearchResult>(2), std::vector<Pose2>(2)), (std::vector<int>{-1, -1}));
  EXPECT_TRUE(consistent({}, {}).empty());
}

TEST(Consistent, FloorsAreNotChangedByOdometry) {
  const std::vector<SearchResult> results{
      result_of({at({0.0, 0.0, 0.0}, 0.9, 1)}),
      result_of({at({1.0, 0.0, 0.0}, 0.5, 0), at({1.0, 0.0, 0.0}, 0.4, 1)})};
  EXPECT_EQ(consistent(results, std::vector<Pose2>{{0, 0, 0}, {1, 0, 0}}), (std::vector<int>{0, 1}));
}

// Neighbours that fit odometry exactly, by chance of the weights: the most probable sequence of all.
TEST(Consistent, EqualsTryingAllSequences) {
  internal::CounterRng random(1);
  for (int round = 0; round < 50; ++round) {
    // Twin lanes 30 m apart; nothing in between is near odometry. A sequence is worth the product of its
    // probabilities, and a lane is left at the price of a jump, which is far below any ratio here.
    std::vector<SearchResult> results;
    std::vector<Pose2> T_odom_robot;
    double lane[2] = {1.0, 1.0};
    for (int i = 0; i < 6; ++i) {
      const double probability = 0.1 + 0.8 * random.uniform();
      results.push_back(
          result_of({at({1.0 * i, 0.0, 0.0}, probability), at({1.0 * i, 30.0, 0.0}, 1.0 - probability)}));
      T_odom_robot.push_back({1.0 * i, 0.0, 0.0});
      lane[0] *= probability;
      lane[1] *= 1.0 - probability;
    }
    EXPECT_EQ(consistent(results, T_odom_robot, {.odometry = {}, .jump_probability = 1e-30}),
              (std::vector<int>(6, lane[0] >= lane[1] ? 0 : 1)));
  }
}

TEST(Consistent, OdometryThatProvesGoodDecidesMore) {
  // Off odometry by 0.25 m, which the stated noise would let pass.
  for (const bool odometry_is_good : {false, true}) {
    internal::CounterRng random(2);
    std::vector<SearchResult> results;
    std::vector<Pose2> T_odom_robot;
    for (int i = 0; i < 20; ++i) {
      const Pose2 pose{1.0 * i, 0.0, 0.0};
      const double off_m = odometry_is_good || i == 10 ? 0.0 : 0.6 * (random.uniform() - 0.5);
      results.push_back(result_of({at(Pose2{pose.x_m + off_m, 0.0, 0.0}, 0.97)}));
      T_odom_robot.push_back(in_odometry(pose));
    }
    results[10] = result_of({at({10.25, 0.0, 0.0}, 0.9), at({10.0, 0.0, 0.0}, 0.05)});
    results[9] = result_of({at({9.0, 0.0, 0.0}, 0.97)});
    results[11] = result_of({at({11.0, 0.0, 0.0}, 0.97)});
    EXPECT_EQ(consistent(results, T_odom_robot)[10], odometry_is_good ? 1 : 0);
  }
}

TEST(Consistent, HowImprobableAHypothesisIsCounts) {
  // Twin lanes: in the first, two scans are nowhere near what they see; the second is never the likeliest.
  std::vector<SearchResult> results;
  std::vector<Pose2> T_odom_robot;
  for (int i = 0; i < 5; ++i) {
    const double first = i == 1 || i == 3 ? 1e-20 : 0.9;
    const double second = i == 1 || i == 3 ? 0.9 : 0.06;
    results.push_back(result_of({at({1.0 * i, 0.0, 0.0}, first), at({1.0 * i, 30.0, 0.0}, second)}));
    T_odom_robot.push_back({1.0 * i, 0.0, 0.0});
  }
  EXPECT_EQ(consistent(results, T_odom_robot), (std::vector<int>(5, 1)));
}

TEST(Consistent, RefusesWhatDoesNotFit) {
  EXPECT_THROW(consistent(std::vector<SearchResult>(2), std::vector<Pose2>(3)), Error);
  for (const double probability : {0.0, -1.0, 1.5, std::numeric_limits<double>::quiet_NaN()})
    EXPECT_THROW(consistent({}, {}, {.odometry = {}, .jump_probability = probability}), Error);
  EXPECT_THROW(consistent({}, {}, {.odometry = {.rotation_rad = -0.1}}), Error);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<SearchResult> results{result_of({at({0.0, 0.0, 0.0}, 0.9)}),
                                          result_of({at({1.0, 0.0, 0.0}, 0.9)})};
  EXPECT_THROW(consistent(results, std::vector<Pose2>{{}, {nan, 0.0, 0.0}}), Error);
  for (const double sigma : {-0.1, nan, 1e300})
    EXPECT_THROW(consistent(results, std::vector<Pose2>(2), {.odometry = {.translation_m = sigma}}), Error);
}

}  // namespace
}  // namespace landfall
