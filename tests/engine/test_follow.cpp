#include <gtest/gtest.h>

#include "engine/sequence/hold_hypothesis.hpp"
#include "landfall/consistent.hpp"
#include "landfall/error.hpp"
#include "rooms.hpp"

namespace landfall {
namespace {

// Two rooms without a difference, 8 m apart, but for a cupboard in the corner of the first one.
GridMap twin_rooms() {
  GridMap map = testing::empty_map(150, 60, 0.1);
  testing::draw_walls(map, {0, 0}, {69, 59});
  testing::draw_walls(map, {80, 0}, {149, 59});
  testing::fill(map, {1, 1}, {10, 8}, Occupancy::occupied);
  return map;
}

struct Follow : ::testing::Test {
  const PreparedMap map{twin_rooms()};
  const std::shared_ptr<const Sensor> sensor = testing::full_circle(60);
  std::vector<Scan> scans;
  std::vector<SearchResult> results;

  void SetUp() override {
    for (int i = 0; i < 5; ++i) {
      Scan scan = testing::look(map, sensor, {2.0 + 0.5 * i, 3.0, 0.1 * i});
      scan.T_odom_robot = Pose2{-3.0, 8.0, 2.0} * *scan.T_map_robot;
      scans.push_back(scan);
    }
    results = search(map, PosePrior{}, scans);
  }
  static bool holds(const SearchResult& result, const Pose2& T_map_robot) {
    return std::any_of(result.hypotheses.begin(), result.hypotheses.end(), [&](const Hypothesis& one) {
      return translation_distance(one.T_map_robot, T_map_robot) < 0.1 &&
             angle_distance(one.T_map_robot.theta_rad, T_map_robot.theta_rad) < 0.02;
    });
  }
};

TEST_F(Follow, AddsThePlaceThatNeighboursKnow) {
  // Scan 2 has lost its right place, and thinks that it is in the other room.
  SearchResult& misled = results[2];
  Hypothesis elsewhere = misled.hypotheses.at(0);
  elsewhere.T_map_robot.x_m += 8.0;
  misled.hypotheses = {elsewhere};
  ASSERT_FALSE(holds(misled, *scans[2].T_map_robot));
  const std::vector<SearchResult> followed = follow(std::span(&map, 1), scans, results);
  EXPECT_TRUE(holds(followed[2], *scans[2].T_map_robot));
  EXPECT_EQ(followed[2].hypotheses.at(0).T_map_robot, elsewhere.T_map_robot);
  EXPECT_EQ(followed[2].verdict, misled.verdict);

  std::vector<Pose2> T_odom_robot;
  for (const Scan& scan : scans) T_odom_robot.push_back(*scan.T_odom_robot);
  const std::vector<int> choice = consistent(followed, T_odom_robot);
  for (std::size_t i = 0; i < scans.size(); ++i) {
    const Pose2& T_map_robot = followed[i].hypotheses.at(static_cast<std::size_t>(choice[i])).T_map_robot;
    EXPECT_LT(translation_distance(T_map_robot, *scans[i].T_map_robot), 0.1) << i;
  }
}

TEST_F(Follow, CarriesOnOverSeveralScans) {
  // Only the last scan knows where it is.
  for (std::size_t i = 0; i + 1 < results.size(); ++i) {
    results[i].hypotheses.resize(1);
    results[i].hypotheses[0].T_map_robot.x_m = 11.0;
    results[i].hypotheses[0].T_map_robot.y_m = 1.0 + static_cast<double>(i);
  }
  const std::vector<SearchResult> followed = follow(std::span(&map, 1), scans, results);
  for (std::size_t i = 0; i < scans.size(); ++i) EXPECT_TRUE(holds(followed[i], *scans[i].T_map_robot)) << i;
}

TEST_F(Follow, WhatIsKnownIsNotAskedAgain) {
  const std::vector<SearchResult> once = follow(std::span(&map, 1), scans, results);
  const std::vector<SearchResult> twice = follow(std::span(&map, 1), scans, once);
  for (std::size_t i = 0; i < scans.size(); ++i)
    EXPECT_EQ(once[i].hypotheses.size(), twice[i].hypotheses.size()) << i;
}

TEST_F(Follow, ScansWithoutEchoesAndPlacesOffTheMapAreLeftAlone) {
  scans[1].ranges_m.assign(scans[1].ranges_m.size(), 1e9F);
  results[1] = search(map, PosePrior{}, scans[1]);
  scans[3].T_odom_robot = *scans[3].T_odom_robot * Pose2{500.0, 0.0, 0.0};
  std::vector<SearchResult> followed;
  ASSERT_NO_THROW(followed = follow(std::span(&map, 1), scans, results));
  EXPECT_TRUE(followed[1].hypotheses.empty());
}

// A corridor without ends in sight: scans say where across it the robot is, odometry where along.
TEST(HoldHypothesis, OdometryPlacesAlongACorridor) {
  GridMap corridor = testing::empty_map(400, 40, 0.1);
  testing::draw_walls(corridor, {0, 10}, {399, 30});
  const PreparedMap map{corridor};
  const Scan one = testing::look(map, testing::full_circle(60, 4.0), {20.0, 2.0, 0.1});
  const std::vector<Scan> two(2, one);
  const Scan composite = merge(two, std::vector<Pose2>{{-0.3, 0.0, 0.0}, {}}, 1, aligned_noise);
  for (const Scan& scan : {one, composite}) {
    SCOPED_TRACE(scan.parts ? "composite" : "single");
    const Pose2 T_map_expected{21.37, 2.11, 0.08};
    const auto held = internal::hold_hypothesis(map, scan, T_map_expected, {0.1, 0.03}, {});
    ASSERT_TRUE(held.has_value());
    EXPECT_NEAR(held->T_map_robot.x_m, T_map_expected.x_m, 0.05);
    EXPECT_NEAR(held->T_map_robot.y_m, 2.0, 0.03);
    EXPECT_GT(held->score, 0);
    EXPECT_GT(held->explained, 0.95);
  }
  EXPECT_FALSE(internal::hold_hypothesis(map, one, {20.0, 500.0, 0.0}, {0.1, 0.03}, {}).has_value());
}

TEST_F(Follow, RefusesWhatDoesNotFit) {
  EXPECT_THROW(follow(std::span(&map, 1), scans, {}), Error);
  EXPECT_THROW(follow({}, scans, results), Error);
  EXPECT_THROW(follow(std::span(&map, 1), scans, results, {}, {.odometry = {}, .jump_probability = -1.0}),
               Error);
  EXPECT_THROW(follow(std::span(&map, 1), scans, results, {}, {.odometry = {.translation_m = -1.0}}), Error);
  scans[2].T_odom_robot.reset();
  EXPECT_THROW(follow(std::span(&map, 1), scans, results), Error);
  EXPECT_TRUE(follow(std::span(&map, 1), {}, {}).empty());
}

}  // namespace
}  // namespace landfall
