#include "landfall/align.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "engine/base/counter_rng.hpp"
#include "landfall/error.hpp"
#include "rooms.hpp"

namespace landfall {
namespace {

constexpr double degree = std::numbers::pi / 180.0;

// Five looks of a half-circle scanner with 1 cm of noise along a bent path through a furnished room.
struct Align : ::testing::Test {
  const PreparedMap map{testing::furnished_room()};
  const std::shared_ptr<const Sensor> sensor =
      std::make_shared<const Sensor>(make_fan({.beams = 181,
                                               .first_rad = -90.0 * degree,
                                               .step_rad = degree,
                                               .range_max_m = 30.0,
                                               .range_noise_m = 0.01}));
  const std::vector<Pose2> T_map_robot{
      {1.5, 2.0, 0.3}, {2.2, 2.3, 0.5}, {3.0, 2.6, 0.2}, {3.8, 2.6, -0.2}, {4.4, 2.4, 0.1}};
  std::vector<Scan> scans = simulate(map, sensor, T_map_robot, {.noise = true, .seed = 3});

  // Odometry with one sigma of error in every step.
  void drift(double translation_m, double rotation_rad, std::uint64_t seed) {
    internal::CounterRng random(seed);
    scans[0].T_odom_robot = Pose2{20.0, -4.0, 1.0};
    for (std::size_t i = 1; i < scans.size(); ++i) {
      Pose2 step = inverse(T_map_robot[i - 1]) * T_map_robot[i];
      step.x_m += translation_m * (2.0 * random.uniform() - 1.0);
      step.y_m += translation_m * (2.0 * random.uniform() - 1.0);
      step.theta_rad += rotation_rad * (2.0 * random.uniform() - 1.0);
      scans[i].T_odom_robot = *scans[i - 1].T_odom_robot * step;
    }
  }
  void expect_right(const std::vector<Pose2>& T_reference_robot, std::size_t reference, double off_m,
                    double off_rad) const {
    ASSERT_EQ(T_reference_robot.size(), scans.size());
    for (std::size_t i = 0; i < scans.size(); ++i) {
      const Pose2 truth = inverse(T_map_robot[reference]) * T_map_robot[i];
      EXPECT_LT(translation_distance(T_reference_robot[i], truth), off_m) << i;
      EXPECT_LT(angle_distance(T_reference_robot[i].theta_rad, truth.theta_rad), off_rad) << i;
    }
  }
};

TEST_F(Align, BadOdometryIsCorrected) {
  for (std::uint64_t seed = 0; seed < 8; ++seed) {
    drift(0.15, 10.0 * degree, seed);
    expect_right(align(scans, 4), 4, 0.12, 1.5 * degree);
  }
}

TEST_F(Align, AnyScanMayBeTheReference) {
  drift(0.1, 5.0 * degree, 1);
  for (std::size_t reference = 0; reference < scans.size(); ++reference) {
    const std::vector<Pose2> poses = align(scans, reference);
    EXPECT_EQ(poses[reference], Pose2{});
    expect_right(poses, reference, 0.12, 1.5 * degree);
  }
}

TEST_F(Align, OneThreadAndTwoAreEqual) {
  drift(0.15, 10.0 * degree, 2);
  EXPECT_EQ(align(scans, 4, {.odometry = {}, .threads = 1}), align(scans, 4, {.odometry = {}, .threads = 2}));
}

TEST_F(Align, WithoutEchoesOdometryStays) {
  drift(0.1, 5.0 * degree, 3);
  for (Scan& scan : scans) scan.ranges_m.assign(scan.ranges_m.size(), 1e9F);
  const std::vector<Pose2> poses = align(scans, 0);
  for (std::size_t i = 0; i < scans.size(); ++i) {
    const Pose2 by_odometry = inverse(*scans[0].T_odom_robot) * *scans[i].T_odom_robot;
    EXPECT_LT(translation_distance(poses[i], by_odometry), 1e-9);
    EXPECT_LT(angle_distance(poses[i].theta_rad, by_odometry.theta_rad), 1e-9);
  }
}

TEST_F(Align, AlongACorridorOdometryDecides) {
  GridMap corridor = testing::empty_map(600, 40, 0.1);
  testing::fill(corridor, {0, 0}, {599, 0}, Occupancy::occupied);
  testing::fill(corridor, {0, 39}, {599, 39}, Occupancy::occupied);
  const PreparedMap long_walls(corridor);
  const auto near_sighted = std::make_shared<const Sensor>(
      make_fan({.beams = 181, .first_rad = -90.0 * degree, .step_rad = degree, .range_max_m = 8.0}));
  const std::vector<Pose2> truth{{28.0, 2.0, 0.0}, {28.8, 2.0, 0.0}, {29.6, 2.0, 0.0}, {30.4, 2.0, 0.0}};
  std::vector<Scan> looks = simulate(long_walls, near_sighted, truth, {.noise = false});
  for (std::size_t i = 0; i < looks.size(); ++i)
    looks[i].T_odom_robot = Pose2{0.8 * static_cast<double>(i), 0.0, 0.05 * static_cast<double>(i)};
  const std::vector<Pose2> poses = align(looks, 0);
  for (std::size_t i = 0; i < poses.size(); ++i) {
    EXPECT_NEAR(poses[i].x_m, 0.8 * static_cast<double>(i), 0.1) << i;
    EXPECT_NEAR(poses[i].y_m, 0.0, 0.05) << i;
    EXPECT_NEAR(poses[i].theta_rad, 0.0, 1.0 * degree) << i;
  }
}

TEST_F(Align, AScanAloneIsItsOwnReference) {
  drift(0.0, 0.0, 0);
  EXPECT_EQ(align(std::span(scans).first(1), 0), std::vector<Pose2>{Pose2{}});
}

TEST_F(Align, RefusesWhatItCannotUse) {
  drift(0.0, 0.0, 0);
  EXPECT_THROW(align({}, 0), Error);
  EXPECT_THROW(align(scans, scans.size()), Error);
  for (const double resolution_m : {0.0, -1.0, 2.0, std::numeric_limits<double>::quiet_NaN()})
    EXPECT_THROW(align(scans, 0, {.odometry = {}, .resolution_m = resolution_m}), Error);
  for (const double sigma : {-0.1, std::numeric_limits<double>::quiet_NaN(), 1e300})
    EXPECT_THROW(align(scans, 0, {.odometry = {.rotation_rad = sigma}}), Error);
  for (const Pose2& pose :
       align(scans, 0, {.odometry = {.rotation_rad = 1000.0, .rotation_relative = 1000.0}}))
    EXPECT_TRUE(is_finite(pose));
  scans[3].T_odom_robot.reset();
  EXPECT_THROW(align(scans, 0), Error);
}

}  // namespace
}  // namespace landfall
