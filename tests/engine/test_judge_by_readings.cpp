// Scans that were condensed from readings: end points propose, readings judge.
#include "engine/rank/judge_by_readings.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <numbers>

#include "landfall/extended_robot.hpp"
#include "landfall/search.hpp"
#include "rooms.hpp"

namespace landfall {
namespace {

constexpr double pi = std::numbers::pi;

// 6 m x 4 m, the same when turned by 180 degrees but for a cupboard in one corner.
const PreparedMap& room() {
  static const PreparedMap map = [] {
    GridMap grid = testing::empty_room(60, 40, 0.1);
    testing::fill(grid, {1, 1}, {9, 7}, Occupancy::occupied);
    return PreparedMap(std::move(grid));
  }();
  return map;
}

std::vector<Scan> turn_at(const Pose2& T_map_robot) {
  Sensor sensor{.name = "sonars", .beams = {}, .range_noise_m = 0.02};
  for (int k = 0; k < 4; ++k)
    sensor.beams.push_back(
        {.T_robot_beam = {0.0, 0.0, k * pi / 2.0}, .half_angle_rad = pi / 12.0, .range_max_m = 8.0});
  constexpr int steps = 24;
  std::vector<Pose2> T_map_turned;
  T_map_turned.reserve(steps);
  for (int i = 0; i < steps; ++i) T_map_turned.push_back(T_map_robot * Pose2{0.0, 0.0, i * 2.0 * pi / steps});
  return simulate(room(), std::make_shared<const Sensor>(sensor), T_map_turned, {.seed = 3});
}

// End points on the four walls, square to them: what a filter might keep.
Scan feet_of_walls(const Pose2& T_map_robot) {
  const double left_m = T_map_robot.x_m - 0.05;
  const double below_m = T_map_robot.y_m - 0.05;
  const double range_m[] = {5.9 - left_m, 3.9 - below_m, left_m, below_m};
  Sensor sensor{.name = "feet", .beams = {}, .range_noise_m = 0.02};
  Scan scan;
  for (int k = 0; k < 4; ++k) {
    sensor.beams.push_back(
        {.T_robot_beam = {0.0, 0.0, k * pi / 2.0 - T_map_robot.theta_rad}, .range_max_m = 20.0});
    scan.ranges_m.push_back(static_cast<float>(range_m[k]));
  }
  scan.sensor = std::make_shared<const Sensor>(sensor);
  return scan;
}

Pose2 turned_by_half(const Pose2& T_map_robot) {
  return Pose2{6.0, 4.0, pi} * T_map_robot;
}

bool is_near(const Pose2& a, const Pose2& b, double most_m, double most_rad) {
  return translation_distance(a, b) <= most_m && angle_distance(a.theta_rad, b.theta_rad) <= most_rad;
}

const SearchOptions options{.method = "fft", .rotation_step_rad = pi / 32.0};

// The feet of the walls fit both ways round; readings that hold the cupboard, or do not, say which it is.
TEST(JudgeByReadings, TellWhichWayRoundTheRobotStands) {
  const Pose2 somewhere{2.43, 2.61, 2.0 * pi / 64.0 * 5.0};
  for (const Pose2& truth : {somewhere, turned_by_half(somewhere)}) {
    Scan scan = feet_of_walls(truth);
    const SearchResult alone = search(room(), PosePrior{}, scan, options);
    ASSERT_GE(alone.hypotheses.size(), 2U);
    EXPECT_EQ(alone.verdict, Verdict::ambiguous);
    scan.measured = std::make_shared<const Scan>(merge_turn(turn_at(truth)));
    const SearchResult judged = search(room(), PosePrior{}, scan, options);
    ASSERT_FALSE(judged.hypotheses.empty());
    EXPECT_TRUE(is_near(judged.hypotheses[0].T_map_robot, truth, 0.08, 0.05));
    EXPECT_GT(judged.hypotheses[0].probability, alone.hypotheses[0].probability);
    EXPECT_GT(judged.counts.rays_cast, alone.counts.rays_cast);
  }
}

// End points that say nothing of where along the room the robot is; readings do.
TEST(JudgeByReadings, MoveThePoseToWhereTheyFit) {
  const Pose2 truth{3.05, 2.05, 0.0};
  Scan scan = feet_of_walls(truth);
  scan.ranges_m[0] = scan.ranges_m[2] = std::numeric_limits<float>::quiet_NaN();
  const PosePrior around{Window{.T_map_robot = truth, .half_theta_rad = 0.2}};
  const SearchResult alone = search(room(), around, scan, options);
  ASSERT_FALSE(alone.hypotheses.empty());
  EXPECT_GT(translation_distance(alone.hypotheses[0].T_map_robot, truth), 0.15);
  scan.measured = std::make_shared<const Scan>(merge_turn(turn_at(truth)));
  const SearchResult judged = search(room(), around, scan, options);
  ASSERT_FALSE(judged.hypotheses.empty());
  EXPECT_LT(translation_distance(judged.hypotheses[0].T_map_robot, truth), 0.12);
}

TEST(JudgeByReadings, AreTheSameForAnyNumberOfThreads) {
  const Scan scan = merge_turn_minima(turn_at({2.43, 2.61, 1.0}));
  SearchOptions threads = options;
  threads.threads = 1;
  const SearchResult one = search(room(), PosePrior{}, scan, threads);
  threads.threads = 3;
  const SearchResult three = search(room(), PosePrior{}, scan, threads);
  ASSERT_FALSE(one.hypotheses.empty());
  ASSERT_EQ(one.hypotheses.size(), three.hypotheses.size());
  for (std::size_t i = 0; i < one.hypotheses.size(); ++i) {
    EXPECT_EQ(one.hypotheses[i].T_map_robot.x_m, three.hypotheses[i].T_map_robot.x_m);
    EXPECT_EQ(one.hypotheses[i].T_map_robot.theta_rad, three.hypotheses[i].T_map_robot.theta_rad);
    EXPECT_EQ(one.hypotheses[i].probability, three.hypotheses[i].probability);
  }
}

}  // namespace
}  // namespace landfall
