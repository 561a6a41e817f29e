#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "engine/base/counter_rng.hpp"
#include "engine/mapping/slam/surface_map.hpp"
#include "landfall/error.hpp"
#include "landfall/mapping.hpp"
#include "landfall/match_scans.hpp"
#include "rooms.hpp"

namespace landfall {
namespace {

std::shared_ptr<const Sensor> scanner() {
  return std::make_shared<const Sensor>(make_fan({.beams = 541,
                                                  .first_rad = -0.75 * std::numbers::pi,
                                                  .step_rad = std::numbers::pi / 360.0,
                                                  .range_max_m = 20.0,
                                                  .range_noise_m = 0.01}));
}

// Forward, turning a little, in the furnished room; truth in the first robot's frame.
struct Drive {
  PreparedMap map{testing::furnished_room()};
  std::vector<Pose2> T_first_robot;
  std::vector<Scan> scans;

  explicit Drive(int steps) {
    std::vector<Pose2> T_map_robot{{2.0, 2.0, 0.2}};
    while (static_cast<int>(T_map_robot.size()) < steps)
      T_map_robot.push_back(T_map_robot.back() * Pose2{0.08, 0.0, 0.03});
    scans = simulate(map, scanner(), T_map_robot, {.seed = 3});
    for (std::size_t i = 0; i < T_map_robot.size(); ++i) {
      T_first_robot.push_back(inverse(T_map_robot.front()) * T_map_robot[i]);
      scans[i].stamp_s = 0.2 * static_cast<double>(i);
      scans[i].T_map_robot.reset();
    }
  }
};

const std::array<SlamOptions, 4> variants{{
    {},
    {.refine = false},
    {.prediction = SlamPrediction::constant_velocity},
    {.matcher = SlamMatcher::branch_and_bound, .resolution_m = 0.02},
}};

class SlamLoop : public ::testing::TestWithParam<std::size_t> {};

TEST_P(SlamLoop, FollowsTheRobot) {
  const Drive drive(25);
  const SlamOptions& options = variants.at(GetParam());
  const SlamResult result = slam(drive.scans, options);
  ASSERT_EQ(result.steps.size(), drive.scans.size());
  const double most_m = options.refine ? 0.02 : 0.08;
  const double most_rad = options.refine ? 0.005 : 0.03;
  for (std::size_t i = 0; i < result.steps.size(); ++i) {
    const SlamStep& step = result.steps[i];
    EXPECT_TRUE(step.accepted && !step.recovered) << i;
    EXPECT_LT(translation_distance(step.T_map_robot, drive.T_first_robot[i]), most_m) << i;
    EXPECT_LT(angle_distance(step.T_map_robot.theta_rad, drive.T_first_robot[i].theta_rad), most_rad) << i;
  }
  EXPECT_EQ(result.map.resolution_m, 0.02);
  EXPECT_EQ(result.map.at(result.map.cell_of({0.5, 0.0})), Occupancy::free);
}
INSTANTIATE_TEST_SUITE_P(All, SlamLoop, ::testing::Range<std::size_t>(0, variants.size()));

TEST(Slam, IsTheSameEachTime) {
  const Drive drive(8);
  const SlamResult a = slam(drive.scans, {.seed = 5});
  const SlamResult b = slam(drive.scans, {.seed = 5});
  EXPECT_EQ(a.map, b.map);
  for (std::size_t i = 0; i < a.steps.size(); ++i)
    EXPECT_EQ(a.steps[i].T_map_robot, b.steps[i].T_map_robot) << i;
}

// A step of two metres and half a turn is beyond the swarm's reach: its match is rejected, the wider search
// finds the robot.
TEST(Slam, RejectsABadMatchAndRecovers) {
  const Drive drive(25);
  const std::vector<Scan> jump{drive.scans[0], drive.scans[1], drive.scans[24]};
  const SlamResult with = slam(jump, {.recovery_reach_m = 2.5});
  EXPECT_TRUE(with.steps[2].accepted && with.steps[2].recovered);
  EXPECT_LT(translation_distance(with.steps[2].T_map_robot, drive.T_first_robot[24]), 0.03);
  const SlamResult without = slam(jump, {.recovery_reach_m = 0.0});
  EXPECT_FALSE(without.steps[2].accepted);
  EXPECT_EQ(without.steps[2].T_map_robot, without.steps[1].T_map_robot);  // as predicted: still
}

// What shows another place entirely is no part of the map.
TEST(Slam, AScanFromElsewhereLeavesTheMapAlone) {
  const Drive drive(4);
  Slam mapping;
  for (const Scan& scan : drive.scans) mapping.add(scan);
  const GridMap before = mapping.map();
  Scan foreign = drive.scans.back();
  for (std::size_t b = 0; b < foreign.ranges_m.size(); ++b)
    foreign.ranges_m[b] = b / 7 % 2 == 0 ? 1.1f + 0.001f * static_cast<float>(b % 97) : 0.6f;
  EXPECT_FALSE(mapping.add(foreign).accepted);
  EXPECT_EQ(mapping.map(), before);
}

TEST(Slam, PredictsByOdometry) {
  Drive drive(25);
  for (std::size_t i = 0; i < drive.scans.size(); ++i) drive.scans[i].T_odom_robot = drive.T_first_robot[i];
  const std::vector<Scan> far{drive.scans[0], drive.scans[1], drive.scans[20]};
  const SlamResult result = slam(far, {.prediction = SlamPrediction::odometry});
  EXPECT_TRUE(result.steps[2].accepted && !result.steps[2].recovered);
  EXPECT_LT(translation_distance(result.steps[2].T_map_robot, drive.T_first_robot[20]), 0.02);
}

TEST(Slam, BadInputIsNamed) {
  const auto message_of = [](const SlamOptions& options) -> std::string {
    try {
      const Slam mapping(options);
    } catch (const Error& error) {
      return error.what();
    }
    return {};
  };
  EXPECT_NE(message_of({.resolution_m = 0.0}).find("resolution_m is 0"), std::string::npos);
  EXPECT_NE(message_of({.swarm = {.particles = 2}}).find("swarm.particles is 2"), std::string::npos);
  EXPECT_NE(message_of({.least_agreement = 1.5}).find("least_agreement"), std::string::npos);
  EXPECT_NE(message_of({.log_odds_miss = 0.1}).find("log_odds_miss"), std::string::npos);
  EXPECT_NE(message_of({.occupied_log_odds = 0.3, .free_log_odds = 0.3}).find("free_log_odds"),
            std::string::npos);
  EXPECT_THROW((void)slam({}), Error);
  Slam mapping;
  EXPECT_THROW(mapping.add(Scan{}), Error);
  EXPECT_EQ(mapping.map().cells, std::vector<Occupancy>{Occupancy::unknown});
}

TEST(Slam, AScanWithoutEchoesFoundsNothing) {
  const Drive drive(2);
  Scan blind = drive.scans[0];
  std::fill(blind.ranges_m.begin(), blind.ranges_m.end(), 20.0f);
  Slam mapping;
  EXPECT_FALSE(mapping.add(blind).accepted);
  EXPECT_TRUE(mapping.add(drive.scans[0]).accepted);
  EXPECT_TRUE(mapping.add(drive.scans[1]).accepted);
}

// A wall at x = 0 whose echoes stray by 3 cm, half of them on either side of a border between squares: one
// row of surfaces, on the mean.
TEST(SurfaceMap, ConvergesToTheMean) {
  internal::SurfaceMap map;
  internal::CounterRng rng(2);
  const auto draw = [&] {
    std::vector<internal::SurfacePoint> points;
    for (double y = -2.0; y < 2.0; y += 0.03)
      points.push_back({.p = {0.06 * rng.uniform() - 0.03, y}, .normal = {-1.0, 0.0}, .has_normal = true});
    return points;
  };
  for (int scan = 0; scan < 50; ++scan) map.add_scan(draw(), {});
  const auto off = map.distance({0.05, 0.7}, {-1.0, 0.0});
  ASSERT_TRUE(off.has_value());
  EXPECT_NEAR(*off, 0.05, 0.006);
  EXPECT_FALSE(map.distance({0.05, 0.7}, {1.0, 0.0}).has_value());  // it faces the other way
  EXPECT_NEAR(map.refine(draw(), {0.06, 0.0, 0.0}).x_m, 0.0, 0.006);
  std::vector<Point2> all;
  for (double y = -2.0; y < 2.0; y += 0.01) all.push_back({0.0, y});
  map.forget(all);
  EXPECT_FALSE(map.distance({0.0, 0.7}, {-1.0, 0.0}).has_value());
}

// A wall along x = 0 that faces left; a ray along it in the noise before it, and one through it.
TEST(SurfaceMap, TellsAWallsNoiseFromWhatIsSeenThrough) {
  internal::SurfaceMap map;
  std::vector<internal::SurfacePoint> points;
  for (double y = -1.0; y < 1.0; y += 0.02)
    points.push_back({.p = {0.0, y}, .normal = {-1.0, 0.0}, .has_normal = true});
  for (int scan = 0; scan < 3; ++scan) map.add_scan(points, {});
  EXPECT_TRUE(map.is_noise_of_a_wall({-0.03, 0.2}, {-0.04, 3.0}, 0.05));   // passes before it
  EXPECT_FALSE(map.is_noise_of_a_wall({-0.03, 0.2}, {2.0, 0.4}, 0.05));    // goes through it
  EXPECT_FALSE(map.is_noise_of_a_wall({-0.20, 0.2}, {-0.2, 3.0}, 0.05));   // too far before it
  EXPECT_FALSE(map.is_noise_of_a_wall({-0.03, 1.5}, {-0.03, 3.0}, 0.05));  // beside its end
}

class ScanMatchers : public ::testing::TestWithParam<std::pair<ScanMatcher, double>> {};

TEST_P(ScanMatchers, FindTheStep) {
  const Drive drive(3);
  const auto [matcher, most_m] = GetParam();
  const Pose2 T_before_after =
      match_scans(drive.scans[0], drive.scans[2], {}, {.matcher = matcher, .range_min_m = 0.0});
  EXPECT_LT(translation_distance(T_before_after, drive.T_first_robot[2]), most_m);
  EXPECT_LT(angle_distance(T_before_after.theta_rad, drive.T_first_robot[2].theta_rad), 0.5 * most_m);
}
INSTANTIATE_TEST_SUITE_P(All, ScanMatchers,
                         ::testing::Values(std::pair{ScanMatcher::icp, 0.04},
                                           std::pair{ScanMatcher::icp_point_to_line, 0.02},
                                           std::pair{ScanMatcher::angle_histogram, 0.06}));

TEST(MatchScans, TooFewPointsStayAtTheStart) {
  const Drive drive(1);
  Scan blind = drive.scans[0];
  std::fill(blind.ranges_m.begin(), blind.ranges_m.end(), 20.0f);
  for (const ScanMatcher matcher :
       {ScanMatcher::icp, ScanMatcher::icp_point_to_line, ScanMatcher::angle_histogram})
    EXPECT_EQ(match_scans(drive.scans[0], blind, {0.1, 0.2, 0.3}, {.matcher = matcher}),
              (Pose2{0.1, 0.2, 0.3}));
  EXPECT_THROW((void)match_scans(drive.scans[0], blind, {}, {.bin_m = 0.0}), Error);
  EXPECT_THROW((void)match_scans(drive.scans[0], drive.scans[0], {NAN, 0.0, 0.0}), Error);
}

}  // namespace
}  // namespace landfall
