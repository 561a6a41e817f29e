// The scene over a grid's merged faces gives the range of the exact walk through the grid's cells; over any
// walls, that of the nearest crossing.
#include <gtest/gtest.h>

#include <random>
#include <string>
#include <vector>

#include "agreement.hpp"
#include "data_folder.hpp"
#include "engine/maps/to_raycast.hpp"
#include "grid_oracle.hpp"
#include "landfall/io.hpp"
#include "raycast/scene.hpp"
#include "wall_oracle.hpp"

namespace landfall {
namespace {

using testing::Agreement;

constexpr double range_max_m = 60.0;

std::vector<raycast::Beam> fan(int count) {
  std::vector<raycast::Beam> beams;
  beams.reserve(static_cast<std::size_t>(count));
  for (int b = 0; b < count; ++b)
    beams.push_back(
        {.x_m = 0.0, .y_m = 0.0, .theta_rad = 0.07 * b, .half_angle_rad = 0.0, .range_max_m = range_max_m});
  return beams;
}

void expect_agreement(const Agreement& agreement) {
  EXPECT_EQ(agreement.wrong, 0) << "of " << agreement.rays;
  EXPECT_LE(agreement.grazing, agreement.rays / 1000) << "of " << agreement.rays;
}

// Fans from random free places.
void compare_fans(const GridMap& map, int poses, std::mt19937& rng, Agreement& agreement) {
  const raycast::Scene scene(internal::to_raycast(to_walls(map)));
  const std::vector<raycast::Beam> beams = fan(90);
  std::vector<float> ranges_m(beams.size());
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  for (int tries = 0, n = 0; n < poses && tries < 1000 * poses; ++tries) {
    const Pose2 T_map_robot =
        map.T_map_grid * Pose2{.x_m = uniform(rng) * map.width_cells * map.resolution_m,
                               .y_m = uniform(rng) * map.height_cells * map.resolution_m,
                               .theta_rad = uniform(rng) * 6.0};
    if (map.at(map.cell_of({.x_m = T_map_robot.x_m, .y_m = T_map_robot.y_m})) != Occupancy::free) continue;
    ++n;
    scene.cast_fans(std::vector{internal::to_raycast(T_map_robot)}, beams, ranges_m);
    for (std::size_t b = 0; b < beams.size(); ++b)
      agreement.add(ranges_m[b], range_max_m, [&](double shift_m) {
        const Pose2 T_robot_beam{.x_m = 0.0, .y_m = 0.0, .theta_rad = beams[b].theta_rad};
        return testing::walked_range_m(map, T_map_robot * T_robot_beam, range_max_m, shift_m);
      });
  }
}

void compare_fans(const std::vector<raycast::Segment>& walls, double extent_m, int poses, std::mt19937& rng,
                  Agreement& agreement) {
  const raycast::Scene scene(walls);
  const std::vector<raycast::Beam> beams = fan(90);
  std::vector<float> ranges_m(beams.size());
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  for (int n = 0; n < poses; ++n) {
    const raycast::Pose pose{
        .x_m = uniform(rng) * extent_m, .y_m = uniform(rng) * extent_m, .theta_rad = uniform(rng) * 6.0};
    scene.cast_fans(std::vector{pose}, beams, ranges_m);
    for (std::size_t b = 0; b < beams.size(); ++b)
      agreement.add(ranges_m[b], range_max_m, [&](double shift_m) {
        const raycast::Pose ray{
            .x_m = pose.x_m, .y_m = pose.y_m, .theta_rad = pose.theta_rad + beams[b].theta_rad};
        return testing::crossed_range_m(walls, ray, range_max_m, shift_m);
      });
  }
}

GridMap random_map(std::mt19937& rng, double occupied_share, const Pose2& T_map_grid) {
  std::uniform_int_distribution<int> size(1, 60);
  GridMap map{.width_cells = size(rng),
              .height_cells = size(rng),
              .resolution_m = 0.02 * size(rng),
              .T_map_grid = T_map_grid,
              .cells = {}};
  std::bernoulli_distribution occupied(occupied_share);
  for (int i = 0; i < map.width_cells * map.height_cells; ++i)
    map.cells.push_back(occupied(rng) ? Occupancy::occupied : Occupancy::free);
  return map;
}

TEST(SceneEqualsGridWalk, OnRandomMaps) {
  std::mt19937 rng(20'261'122);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  Agreement agreement;
  for (int n = 0; n < 150; ++n) {
    const Pose2 T_map_grid{
        .x_m = 1e4 * uniform(rng), .y_m = 1e4 * uniform(rng), .theta_rad = n % 2 == 0 ? 0.0 : uniform(rng)};
    compare_fans(random_map(rng, n % 3 == 0 ? 0.3 : 0.03, T_map_grid), 20, rng, agreement);
  }
  EXPECT_GT(agreement.rays, 200'000);
  expect_agreement(agreement);
}

TEST(SceneEqualsGridWalk, OnRealMaps) {
  LANDFALL_REQUIRE_DATA();
  std::mt19937 rng(1);
  for (const char* place : {"intel", "csail", "aces", "acapulco", "infinite_corridor"}) {
    SCOPED_TRACE(place);
    Agreement agreement;
    compare_fans(load_grid_map(testing::data_folder() / place / "map.yaml"), 100, rng, agreement);
    EXPECT_EQ(agreement.rays, 9000);
    expect_agreement(agreement);
  }
}

TEST(SceneEqualsNearestCrossing, OnRandomWalls) {
  std::mt19937 rng(2);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  Agreement agreement;
  for (const int count : {1, 2, 10, 100}) {
    std::vector<raycast::Segment> walls;
    walls.reserve(static_cast<std::size_t>(count));
    for (int i = 0; i < count; ++i)
      walls.push_back({40.0 * uniform(rng), 40.0 * uniform(rng), 40.0 * uniform(rng), 40.0 * uniform(rng)});
    compare_fans(walls, 40.0, 50, rng, agreement);
  }
  expect_agreement(agreement);
}

TEST(SceneEqualsNearestCrossing, OnRealPlans) {
  LANDFALL_REQUIRE_DATA();
  std::mt19937 rng(3);
  for (const char* plan : {"mall_site1_F1.json", "mall_site1_B1.json", "AMROffice.json"}) {
    SCOPED_TRACE(plan);
    const WallMap map = load_wall_map(testing::data_folder() / "plans" / plan);
    Agreement agreement;
    compare_fans(internal::to_raycast(map), 200.0, 30, rng, agreement);
    expect_agreement(agreement);
  }
}

}  // namespace
}  // namespace landfall
