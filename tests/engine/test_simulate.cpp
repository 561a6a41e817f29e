#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <vector>

#include "drawn_map.hpp"
#include "landfall/error.hpp"
#include "landfall/simulate.hpp"

namespace landfall {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr double pi = std::numbers::pi;

// Free inside: [0.5, 2.5] x [0.5, 1.5] m.
const GridMap room = testing::drawn_map({"######",  //
                                         "#....#",  //
                                         "#....#",  //
                                         "######"},
                                        0.5);

Sensor four_beams(double range_max_m = 80.0) {
  return make_fan(
      {.name = "four", .beams = 4, .first_rad = 0.0, .step_rad = pi / 2, .range_max_m = range_max_m});
}

TEST(SimulateRanges, ReachesTheFacesOfOccupiedCells) {
  const std::vector<Pose2> poses{{1.0, 1.0, 0.0}, {2.25, 0.75, pi / 2}};
  const std::vector<float> ranges_m = simulate_ranges(PreparedMap(room), four_beams(), poses);
  const std::vector<float> expected{1.5f, 0.5f, 0.5f, 0.5f, 0.75f, 1.75f, 0.25f, 0.25f};
  ASSERT_EQ(ranges_m.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_NEAR(ranges_m[i], expected[i], 1e-5) << i;
}

TEST(SimulateRanges, SaysInfinityBeyondTheRange) {
  const std::vector<float> ranges_m =
      simulate_ranges(PreparedMap(room), four_beams(1.0), std::vector<Pose2>{{1.0, 1.0, 0.0}});
  EXPECT_EQ(ranges_m[0], infinity);
  EXPECT_NEAR(ranges_m[1], 0.5f, 1e-5);
}

TEST(SimulateRanges, ASonarSeesTheNearestPointOfItsCone) {
  Sensor sonar = four_beams();
  for (Beam& beam : sonar.beams) beam.half_angle_rad = pi / 4;
  // At (2.2, 1.0): 0.3 m from the right wall. The beam forward touches it head on; that to the left is cut
  // at its edges where 45 degrees meet the upper wall, 0.5 m away head on.
  const std::vector<float> ranges_m =
      simulate_ranges(PreparedMap(room), sonar, std::vector<Pose2>{{2.2, 1.0, 0.0}, {2.2, 1.0, pi / 4}});
  EXPECT_NEAR(ranges_m[0], 0.3f, 1e-6);
  EXPECT_NEAR(ranges_m[1], 0.3f * std::sqrt(2.0f), 1e-6);  // the right wall where the cone's edge meets it
  EXPECT_NEAR(ranges_m[4], 0.3f, 1e-6);                    // turned by 45 degrees: the edge is head on
}

// Numbers that a raycaster may not take: as far as doubles go, by the pose or by the mount.
TEST(SimulateRanges, SaysInfinityFromAnywhereFarAway) {
  const PreparedMap plan(WallMap{.walls = {{{0.0, 0.0}, {10.0, 0.0}}, {{10.0, 0.0}, {10.0, 5.0}}}});
  for (const PreparedMap& map : {PreparedMap(room), plan}) {
    for (const double far_m : {1e17, 1e19, 1e38, 1e39, 1e300, 1.7e308}) {
      for (const double half_angle_rad : {0.0, 0.1}) {
        Sensor sensor = four_beams(3.0);
        sensor.beams[1].T_robot_beam.x_m = far_m;
        sensor.beams[2].T_robot_beam.y_m = -far_m;
        for (Beam& beam : sensor.beams) beam.half_angle_rad = half_angle_rad;
        const std::vector<Pose2> poses{{1.0, 1.0, 0.0}, {far_m, 1.0, 0.5}, {1.0, -far_m, 0.0}};
        const std::vector<float> ranges_m = simulate_ranges(map, sensor, poses);
        for (std::size_t i = 0; i < ranges_m.size(); ++i) {
          EXPECT_FALSE(std::isnan(ranges_m[i])) << far_m << " " << i;
          if (i != 0 && i != 3) {
            EXPECT_EQ(ranges_m[i], infinity) << far_m << " " << i;
          }
        }
      }
    }
  }
}

TEST(RayCaster, IsNamedByMapAndBeams) {
  const PreparedMap grid(room);
  const PreparedMap plan(WallMap{.walls = {{{0.0, 0.0}, {10.0, 0.0}}, {{10.0, 0.0}, {10.0, 5.0}}}});
  Sensor sensor = four_beams();
  EXPECT_EQ(ray_caster(grid, sensor), "distance_walk");
  EXPECT_EQ(ray_caster(plan, sensor), "embree");
  sensor.beams[1].half_angle_rad = 0.1;
  EXPECT_EQ(ray_caster(grid, sensor), "distance_walk, segment_tree");
  for (Beam& beam : sensor.beams) beam.half_angle_rad = 0.1;
  EXPECT_EQ(ray_caster(plan, sensor), "segment_tree");
  EXPECT_THROW(ray_caster(grid, Sensor{}), Error);
}

TEST(SimulateRanges, APlanIsSeenByItsOwnWalls) {
  const WallMap plan{
      .walls = {{{0.0, 0.0}, {10.0, 0.0}}, {{10.0, 0.0}, {10.0, 5.0}}, {{10.0, 5.0}, {0.0, 0.0}}}};
  const PreparedMap map(plan, {.resolution_m = 0.5});
  const std::vector<float> ranges_m =
      simulate_ranges(map, four_beams(), std::vector<Pose2>{{8.0, 1.03, 0.0}});
  EXPECT_NEAR(ranges_m[0], 2.0f, 1e-5);
  EXPECT_NEAR(ranges_m[1], 2.97f, 1e-5);  // the slope: y = 4 at x = 8
  EXPECT_NEAR(ranges_m[3], 1.03f, 1e-5);
}

TEST(Simulate, WithoutNoiseGivesTheRangesAndTheMaximum) {
  const auto sensor = std::make_shared<const Sensor>(four_beams(1.0));
  const std::vector<Pose2> poses{{1.0, 1.0, 0.0}};
  const std::vector<Scan> scans = simulate(PreparedMap(room), sensor, poses, {.noise = false});
  ASSERT_EQ(scans.size(), 1u);
  EXPECT_EQ(scans[0].T_map_robot, poses[0]);
  EXPECT_EQ(scans[0].sensor, sensor);
  EXPECT_EQ(scans[0].ranges_m[0], 1.0f);
  EXPECT_EQ(classify(sensor->beams[0], scans[0].ranges_m[0]), Reading::no_echo);
  EXPECT_NEAR(scans[0].ranges_m[1], 0.5f, 1e-5);
}

TEST(Simulate, NoiseHasTheSensorsSigma) {
  Sensor sensor = four_beams();
  sensor.range_noise_m = 0.02;
  sensor.range_noise_relative = 0.01;
  const std::vector<Pose2> poses(20'000, Pose2{1.0, 1.0, 0.0});
  const std::vector<Scan> scans =
      simulate(PreparedMap(room), std::make_shared<const Sensor>(sensor), poses, {.seed = 3});
  double sum_m = 0.0, squares = 0.0;
  for (const Scan& scan : scans) {
    const double error_m = scan.ranges_m[0] - 1.5;
    sum_m += error_m;
    squares += error_m * error_m;
  }
  const auto n = static_cast<double>(scans.size());
  const double sigma_m = 0.02 + 0.01 * 1.5;
  EXPECT_NEAR(sum_m / n, 0.0, 5.0 * sigma_m / std::sqrt(n));
  EXPECT_NEAR(std::sqrt(squares / n), sigma_m, 5.0 * sigma_m / std::sqrt(2.0 * n));
}

TEST(Simulate, NoiseDependsOnSeedPoseAndBeamAlone) {
  const PreparedMap map(room);
  const auto sensor = std::make_shared<const Sensor>(four_beams());
  const std::vector<Pose2> poses(40, Pose2{1.0, 1.0, 0.3});
  const std::vector<Scan> all = simulate(map, sensor, poses, {.seed = 5});
  const std::vector<Scan> few = simulate(map, sensor, std::span(poses).first(3), {.seed = 5});
  for (std::size_t i = 0; i < few.size(); ++i) EXPECT_EQ(few[i].ranges_m, all[i].ranges_m);
  EXPECT_NE(all[0].ranges_m, all[1].ranges_m);
  EXPECT_NE(simulate(map, sensor, poses, {.seed = 6})[0].ranges_m, all[0].ranges_m);
}

TEST(Simulate, NoiseNeverMakesARangeNegative) {
  Sensor sensor = four_beams();
  sensor.range_noise_m = 10.0;
  const std::vector<Pose2> poses(100, Pose2{1.0, 1.0, 0.0});
  for (const Scan& scan : simulate(PreparedMap(room), std::make_shared<const Sensor>(sensor), poses))
    for (const float range_m : scan.ranges_m) EXPECT_GE(range_m, 0.0f);
}

TEST(Simulate, RefusesWhatItCannotCast) {
  const PreparedMap map(room);
  const std::vector<Pose2> bad{{1.0, std::nan(""), 0.0}};
  EXPECT_THROW(simulate(map, nullptr, {}), Error);
  EXPECT_THROW(simulate_ranges(map, Sensor{}, {}), Error);
  EXPECT_THROW(simulate_ranges(map, four_beams(), bad), Error);
}

}  // namespace
}  // namespace landfall
