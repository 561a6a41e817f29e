// Readings of cones, of which many are too long, against their mixture written out.
#include "engine/rank/cone_model.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "landfall/prepared_map.hpp"
#include "rooms.hpp"

namespace landfall::internal {
namespace {

constexpr float none = std::numeric_limits<float>::infinity();
constexpr float nan = std::numeric_limits<float>::quiet_NaN();
constexpr double noise_m = 0.1;
constexpr double range_max_m = 5.0;
constexpr double depth_m = 0.1;  // of a cell
const Pose2 facing_the_wall{2.05, 2.05, 0.0};

// 10 m wide, with a wall whose face is at x = 4.0 m: 1.95 m from facing_the_wall.
const PreparedMap& floor_with_a_wall() {
  static const PreparedMap map = [] {
    GridMap grid = testing::empty_map(100, 40, depth_m);
    testing::fill(grid, {40, 0}, {40, 39}, Occupancy::occupied);
    return PreparedMap(std::move(grid));
  }();
  return map;
}

const PreparedMap& plan_with_a_wall() {
  static const PreparedMap map(
      WallMap{.walls = {{{4.0, 0.0}, {4.0, 4.0}}, {{0.0, 0.0}, {0.0, 4.0}}, {{10.0, 0.0}, {10.0, 4.0}}}});
  return map;
}

Scan cones(const std::vector<float>& ranges_m) {
  Sensor sensor{.name = "sonar", .beams = {}, .range_noise_m = noise_m};
  sensor.beams.assign(ranges_m.size(),
                      {.half_angle_rad = std::numbers::pi / 12.0, .range_max_m = range_max_m});
  return {.sensor = std::make_shared<const Sensor>(sensor), .ranges_m = ranges_m};
}

double log_likelihood(const PreparedMap& map, const std::vector<float>& ranges_m, const Pose2& pose) {
  return ConeModel(map.state(), cones(ranges_m)).log_likelihood(pose);
}

double mixture(double off_m, double variance) {
  const double at_wall =
      0.44 * std::exp(-0.5 * off_m * off_m / variance) / std::sqrt(2.0 * std::numbers::pi * variance);
  return std::log(at_wall + (off_m > 0.0 ? 0.53 : 0.06) / range_max_m);
}

TEST(ConeModel, TheWallIsWithinTheCellThatTheConeMeets) {
  const double variance = noise_m * noise_m + depth_m * depth_m / 12.0;
  for (const double off_m : {-1.0, -0.15, -0.05, 0.05, 0.2, 2.0})
    EXPECT_NEAR(log_likelihood(floor_with_a_wall(), {static_cast<float>(2.0 + off_m)}, facing_the_wall),
                mixture(off_m, variance), 1e-4)
        << off_m;
}

TEST(ConeModel, APlansWallsAreWhereTheyAre) {
  for (const double off_m : {-0.5, -0.1, 0.1, 0.5})
    EXPECT_NEAR(log_likelihood(plan_with_a_wall(), {static_cast<float>(1.95 + off_m)}, facing_the_wall),
                mixture(off_m, noise_m * noise_m), 1e-4)
        << off_m;
}

TEST(ConeModel, LongReadingsAreCommonAndShortOnesAreNot) {
  const double shorter = log_likelihood(floor_with_a_wall(), {1.0F}, facing_the_wall);
  const double longer = log_likelihood(floor_with_a_wall(), {3.0F}, facing_the_wall);
  EXPECT_NEAR(longer - shorter, std::log(0.53 / 0.06), 1e-4);
  // As likely a little beyond the wall as far beyond it.
  EXPECT_NEAR(log_likelihood(floor_with_a_wall(), {4.5F}, facing_the_wall), longer, 1e-4);
}

TEST(ConeModel, EchoesThatAreMissingAndThatShouldBe) {
  const Pose2 nothing_ahead{4.55, 2.05, 0.0};
  EXPECT_NEAR(log_likelihood(floor_with_a_wall(), {none}, facing_the_wall), std::log(0.25), 1e-6);
  EXPECT_NEAR(log_likelihood(floor_with_a_wall(), {none}, nothing_ahead), std::log(0.94), 1e-6);
  EXPECT_NEAR(log_likelihood(floor_with_a_wall(), {2.0F}, nothing_ahead), std::log(0.06 / range_max_m), 1e-6);
}

TEST(ConeModel, ManyReadingsWeighAsTwenty) {
  const double one = log_likelihood(floor_with_a_wall(), {2.1F}, facing_the_wall);
  for (const std::size_t count : {2U, 20U, 40U, 256U}) {
    std::vector<float> ranges_m(count, 2.1F);
    ranges_m.push_back(nan);  // no reading
    EXPECT_NEAR(log_likelihood(floor_with_a_wall(), ranges_m, facing_the_wall),
                std::min<double>(20.0, static_cast<double>(count)) * one, 1e-3);
  }
}

}  // namespace
}  // namespace landfall::internal
