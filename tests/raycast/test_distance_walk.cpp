// The walk by free squares gives the range of the walk from cell to cell, and that of Embree over the grid's
// faces.
#include "raycast/distance_walk.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <numbers>
#include <random>

#include "agreement.hpp"
#include "data_folder.hpp"
#include "drawn_map.hpp"
#include "engine/maps/to_raycast.hpp"
#include "grid_oracle.hpp"
#include "landfall/io.hpp"
#include "landfall/wall_map.hpp"
#include "raycast/wall_trace.hpp"

namespace landfall {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr double pi = std::numbers::pi;

raycast::DistanceWalk walk_over(const GridMap& map) {
  return raycast::DistanceWalk(internal::to_raycast(map));
}

raycast::Beam beam_at(double theta_rad, double range_max_m, double x_m = 0.0, double y_m = 0.0) {
  return {.x_m = x_m, .y_m = y_m, .theta_rad = theta_rad, .half_angle_rad = 0.0, .range_max_m = range_max_m};
}

float range_m(const GridMap& map, const raycast::Pose& pose, const raycast::Beam& beam) {
  float range = -1.0f;
  walk_over(map).cast_fans({&pose, 1}, {&beam, 1}, {&range, 1});
  return range;
}

const GridMap room = testing::drawn_map(
    {
        "######",
        "#....#",
        "#..#.#",
        "######",
    },
    0.5);

TEST(DistanceWalk, GivesTheDistanceToTheFace) {
  EXPECT_FLOAT_EQ(range_m(room, {0.75, 1.25, 0.0}, beam_at(0.0, 80.0)), 1.75f);
  EXPECT_FLOAT_EQ(range_m(room, {0.75, 0.75, 0.0}, beam_at(0.0, 80.0)), 0.75f);
  EXPECT_FLOAT_EQ(range_m(room, {0.75, 0.75, pi}, beam_at(0.0, 80.0)), 0.25f);
  EXPECT_EQ(range_m(room, {0.75, 1.25, 0.0}, beam_at(0.0, 1.7)), infinity);
  // The mount is turned with the robot: from (1.25, 0.75) upwards.
  EXPECT_FLOAT_EQ(range_m(room, {0.75, 0.75, pi / 2}, beam_at(0.0, 80.0, 0.0, -0.5)), 0.75f);
}

TEST(DistanceWalk, LeavesTheWallItStartsIn) {
  EXPECT_FLOAT_EQ(range_m(room, {0.25, 1.25, 0.0}, beam_at(0.0, 80.0)), 0.25f);
  EXPECT_FLOAT_EQ(range_m(room, {0.25, 1.25, -pi / 2}, beam_at(0.0, 80.0)),
                  1.25f);  // along it, out of the map
  EXPECT_EQ(range_m(room, {0.25, 1.25, -pi / 2}, beam_at(0.0, 1.2)), infinity);
}

// Limits on either side of the face, on it, and shorter than the first cell.
TEST(DistanceWalk, LooksForTheWayOutNoFartherThanTheRange) {
  const GridMap solid = testing::drawn_map(std::vector<std::string>(40, std::string(60, '#')), 0.5);
  EXPECT_FLOAT_EQ(range_m(solid, {0.25, 10.0, 0.0}, beam_at(0.0, 80.0)), 29.75f);
  EXPECT_FLOAT_EQ(range_m(solid, {0.25, 10.0, 0.0}, beam_at(0.0, 29.75)), 29.75f);
  EXPECT_EQ(range_m(solid, {0.25, 10.0, 0.0}, beam_at(0.0, 29.7)), infinity);
  EXPECT_EQ(range_m(solid, {15.0, 10.0, 0.3}, beam_at(0.0, 0.1)), infinity);
  EXPECT_NEAR(range_m(solid, {15.0, 19.9, pi / 2}, beam_at(0.0, 0.2)), 0.1f, 1e-6);
}

TEST(DistanceWalk, EntersTheMapFromOutside) {
  EXPECT_FLOAT_EQ(range_m(room, {-7.0, 1.25, 0.0}, beam_at(0.0, 80.0)), 7.0f);
  EXPECT_EQ(range_m(room, {-7.0, 1.25, 0.0}, beam_at(0.0, 6.9)), infinity);
  EXPECT_EQ(range_m(room, {-7.0, 1.25, pi}, beam_at(0.0, 80.0)), infinity);
  EXPECT_EQ(range_m(room, {-7.0, 5.0, 0.0}, beam_at(0.0, 80.0)), infinity);
  EXPECT_FLOAT_EQ(range_m(room, {0.75, 1.25, 0.0}, beam_at(0.0, 80.0, -7.75, 0.0)), 7.0f);
  EXPECT_EQ(range_m(room, {1e12, 1e12, 0.0}, beam_at(0.0, 80.0)), infinity);
  const GridMap open = testing::drawn_map({"..#"});
  EXPECT_FLOAT_EQ(range_m(open, {-1.0, 0.5, 0.0}, beam_at(0.0, 80.0)), 3.0f);
}

TEST(DistanceWalk, LeavesConesToOthers) {
  const raycast::Pose pose{0.75, 1.25, 0.0};
  std::vector<raycast::Beam> beams{beam_at(0.0, 80.0), beam_at(0.0, 80.0), beam_at(pi, 80.0)};
  beams[1].half_angle_rad = 0.1;
  std::vector<float> ranges_m{1.0f, 42.0f, 2.0f};
  walk_over(room).cast_fans({&pose, 1}, beams, ranges_m);
  EXPECT_FLOAT_EQ(ranges_m[0], 1.75f);
  EXPECT_EQ(ranges_m[1], 42.0f);
  EXPECT_FLOAT_EQ(ranges_m[2], 0.25f);
}

GridMap random_map(std::mt19937& rng, double occupied_share, const Pose2& T_map_grid) {
  std::uniform_int_distribution<int> size(1, 90);
  GridMap map{.width_cells = size(rng),
              .height_cells = size(rng),
              .resolution_m = 0.01 * size(rng),
              .T_map_grid = T_map_grid,
              .cells = {}};
  std::bernoulli_distribution occupied(occupied_share);
  for (int i = 0; i < map.width_cells * map.height_cells; ++i)
    map.cells.push_back(occupied(rng) ? Occupancy::occupied : Occupancy::free);
  return map;
}

// Poses within the map and around it.
raycast::Pose random_pose(std::mt19937& rng, const GridMap& map, double margin) {
  std::uniform_real_distribution<double> uniform(-margin, 1.0 + margin);
  std::uniform_real_distribution<double> theta_rad(-3.2, 3.2);
  return internal::to_raycast(map.T_map_grid *
                              Pose2{.x_m = uniform(rng) * map.width_cells * map.resolution_m,
                                    .y_m = uniform(rng) * map.height_cells * map.resolution_m,
                                    .theta_rad = theta_rad(rng)});
}

bool starts_in_wall(const GridMap& map, double x_m, double y_m) {
  return map.at(map.cell_of({.x_m = x_m, .y_m = y_m})) == Occupancy::occupied;
}

void compare_with_cells(const GridMap& map, int poses, double range_max_m, std::mt19937& rng,
                        testing::Agreement& agreement) {
  const raycast::DistanceWalk walk = walk_over(map);
  std::uniform_real_distribution<double> mount_m(-0.3, 0.3);
  std::vector<raycast::Beam> beams;
  beams.reserve(90);
  for (int b = 0; b < 90; ++b)
    beams.push_back(beam_at(0.07 * b, range_max_m, b < 45 ? 0.0 : mount_m(rng), b < 45 ? 0.0 : mount_m(rng)));
  std::vector<raycast::Pose> at;
  at.reserve(static_cast<std::size_t>(poses));
  for (int n = 0; n < poses; ++n) at.push_back(random_pose(rng, map, 0.1));
  std::vector<float> ranges_m(at.size() * beams.size());
  walk.cast_fans(at, beams, ranges_m);
  for (std::size_t i = 0; i < ranges_m.size(); ++i) {
    const raycast::Pose& pose = at[i / beams.size()];
    const raycast::Beam& beam = beams[i % beams.size()];
    const Pose2 T_map_beam = Pose2{.x_m = pose.x_m, .y_m = pose.y_m, .theta_rad = pose.theta_rad} *
                             Pose2{.x_m = beam.x_m, .y_m = beam.y_m, .theta_rad = beam.theta_rad};
    if (starts_in_wall(map, T_map_beam.x_m, T_map_beam.y_m)) continue;
    agreement.add(ranges_m[i], range_max_m, [&](double shift_m) {
      return testing::walked_range_m(map, T_map_beam, range_max_m, shift_m);
    });
  }
}

TEST(DistanceWalkEqualsGridWalk, OnRandomMaps) {
  std::mt19937 rng(20'261'123);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  testing::Agreement agreement;
  for (int n = 0; n < 150; ++n) {
    const Pose2 T_map_grid{
        .x_m = 1e4 * uniform(rng), .y_m = 1e4 * uniform(rng), .theta_rad = n % 2 == 0 ? 0.0 : uniform(rng)};
    compare_with_cells(random_map(rng, n % 3 == 0 ? 0.3 : 0.01, T_map_grid), 20, n % 5 == 0 ? 3.0 : 60.0, rng,
                       agreement);
  }
  EXPECT_GT(agreement.rays, 200'000);
  EXPECT_EQ(agreement.wrong, 0);
  EXPECT_LE(agreement.grazing, agreement.rays / 1000);
}

TEST(DistanceWalkEqualsGridWalk, OnRealMaps) {
  LANDFALL_REQUIRE_DATA();
  std::mt19937 rng(1);
  for (const char* place : {"intel", "csail", "aces", "acapulco", "infinite_corridor"}) {
    SCOPED_TRACE(place);
    testing::Agreement agreement;
    compare_with_cells(load_grid_map(testing::data_folder() / place / "map.yaml"), 100, 60.0, rng, agreement);
    EXPECT_GT(agreement.rays, 8000);
    EXPECT_EQ(agreement.wrong, 0);
    EXPECT_LE(agreement.grazing, agreement.rays / 1000);
  }
}

// From within walls as well, with ranges that end within them.
TEST(DistanceWalkEqualsWallTrace, FromAnywhere) {
  std::mt19937 rng(9);
  int rays = 0;
  int differ = 0;
  for (int n = 0; n < 60; ++n) {
    const GridMap map = random_map(rng, 0.5, {.x_m = 3.0, .y_m = -2.0, .theta_rad = 0.1 * n});
    const raycast::WallTrace trace(internal::to_raycast(to_walls(map)));
    const raycast::DistanceWalk walk = walk_over(map);
    std::vector<raycast::Ray> from;
    for (int i = 0; i < 400; ++i) {
      const raycast::Pose pose = random_pose(rng, map, 0.2);
      from.push_back({.x_m = pose.x_m,
                      .y_m = pose.y_m,
                      .dx = static_cast<float>(std::cos(pose.theta_rad)),
                      .dy = static_cast<float>(std::sin(pose.theta_rad)),
                      .range_max_m = i % 2 == 0 ? 30.0f : 0.3f});
    }
    std::vector<float> walked_m(from.size());
    std::vector<float> seen_m(from.size());
    walk.cast_rays(from, walked_m);
    trace.cast_rays(from, seen_m);
    for (std::size_t i = 0; i < from.size(); ++i, ++rays)
      if (walked_m[i] != seen_m[i] && !(std::abs(walked_m[i] - seen_m[i]) <= testing::range_tolerance_m))
        ++differ;
  }
  EXPECT_LE(differ, rays / 1000) << "of " << rays;  // those that graze a corner
}

}  // namespace
}  // namespace landfall
