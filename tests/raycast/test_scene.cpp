#include "raycast/scene.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <thread>
#include <vector>

namespace landfall::raycast {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr double pi = std::numbers::pi;

// A room of 4 x 3 m with its lower left corner at (x, y).
std::vector<Segment> room_at(double x, double y) {
  return {
      {x, y, x + 4.0, y}, {x + 4.0, y, x + 4.0, y + 3.0}, {x + 4.0, y + 3.0, x, y + 3.0}, {x, y + 3.0, x, y}};
}

Beam ray_beam(double theta_rad, double range_max_m = 80.0) {
  return {.x_m = 0.0, .y_m = 0.0, .theta_rad = theta_rad, .half_angle_rad = 0.0, .range_max_m = range_max_m};
}

std::vector<float> cast(const Scene& scene, const std::vector<Pose>& poses, const std::vector<Beam>& beams) {
  std::vector<float> ranges_m(poses.size() * beams.size());
  scene.cast_fans(poses, beams, ranges_m);
  return ranges_m;
}

TEST(Scene, GivesTheDistanceToTheNearestWall) {
  const Scene scene(room_at(0.0, 0.0));
  const std::vector<float> ranges_m =
      cast(scene, {{1.0, 1.0, 0.0}, {1.0, 1.0, pi / 2}},
           {ray_beam(0.0), ray_beam(pi / 2), ray_beam(pi), ray_beam(-pi / 2), ray_beam(pi / 4)});
  const std::vector<float> expected{3.0f, 2.0f, 1.0f, 1.0f, 2.0f * std::sqrt(2.0f),  //
                                    2.0f, 1.0f, 1.0f, 3.0f, std::sqrt(2.0f)};
  ASSERT_EQ(ranges_m.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_NEAR(ranges_m[i], expected[i], 1e-5) << i;
}

TEST(Scene, AppliesTheMountOfEachBeam) {
  const Scene scene(room_at(0.0, 0.0));
  // Robot at (1, 1) facing up; the beam sits 0.5 m ahead and 0.25 m to the left: (0.75, 1.5), facing left.
  const Beam beam{.x_m = 0.5, .y_m = 0.25, .theta_rad = pi / 2, .half_angle_rad = 0.0, .range_max_m = 80.0};
  EXPECT_NEAR(cast(scene, {{1.0, 1.0, pi / 2}}, {beam})[0], 0.75, 1e-5);
}

TEST(Scene, SaysInfinityBeyondARangeLimitOrWithoutWalls) {
  const Scene scene(room_at(0.0, 0.0));
  const std::vector<float> ranges_m =
      cast(scene, {{1.0, 1.0, 0.0}}, {ray_beam(0.0, 2.9), ray_beam(0.0, 3.1)});
  EXPECT_EQ(ranges_m[0], infinity);
  EXPECT_NEAR(ranges_m[1], 3.0f, 1e-5);
  EXPECT_EQ(cast(scene, {{-1.0, 1.0, pi}}, {ray_beam(0.0)})[0], infinity);
  EXPECT_EQ(cast(Scene({}), {{0.0, 0.0, 0.0}}, {ray_beam(0.0)})[0], infinity);
}

TEST(Scene, KeepsItsPrecisionFarFromTheOrigin) {
  const Scene scene(room_at(500'000.0, 4'000'000.0));
  const std::vector<float> ranges_m =
      cast(scene, {{500'001.0, 4'000'001.0, 0.0}}, {ray_beam(0.0), ray_beam(pi / 2)});
  EXPECT_NEAR(ranges_m[0], 3.0f, 1e-5);
  EXPECT_NEAR(ranges_m[1], 2.0f, 1e-5);
}

TEST(Scene, SingleRaysEqualFans) {
  const Scene scene(room_at(-2.0, -1.5));
  std::vector<Beam> beams;
  std::vector<Ray> rays;
  for (int i = 0; i < 37; ++i) {  // two packets and a part of one
    const double theta_rad = -pi + 0.17 * i;
    beams.push_back(ray_beam(theta_rad));
    rays.push_back({.x_m = 0.3,
                    .y_m = -0.4,
                    .dx = static_cast<float>(std::cos(theta_rad)),
                    .dy = static_cast<float>(std::sin(theta_rad)),
                    .range_max_m = 80.0f});
  }
  std::vector<float> ranges_m(rays.size());
  scene.cast_rays(rays, ranges_m);
  const std::vector<float> fan_m = cast(scene, {{0.3, -0.4, 0.0}}, beams);
  for (std::size_t i = 0; i < rays.size(); ++i) EXPECT_NEAR(ranges_m[i], fan_m[i], 1e-5) << i;
}

// Aimed at the corners themselves, to float precision, from everywhere: each ray must end at a wall.
TEST(Scene, NoRaySlipsThroughACorner) {
  std::mt19937 rng(11);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  std::vector<Segment> polygon;
  constexpr int corners = 24;
  const auto corner = [](int i, double turn_rad) {
    const double angle_rad = 2.0 * pi * (i % corners) / corners + turn_rad;
    return std::pair{5.0 * std::cos(angle_rad), 5.0 * std::sin(angle_rad)};
  };
  for (int i = 0; i < corners; ++i) {
    const auto [ax, ay] = corner(i, 0.1);
    const auto [bx, by] = corner(i + 1, 0.1);
    polygon.push_back({ax, ay, bx, by});
  }
  const Scene scene(polygon);
  std::vector<Ray> rays;
  for (int n = 0; n < 50'000; ++n) {
    const double x = uniform(rng) * 4.0 - 2.0;
    const double y = uniform(rng) * 4.0 - 2.0;
    const auto [cx, cy] = corner(n, 0.1);
    const double length = std::hypot(cx - x, cy - y);
    rays.push_back({.x_m = x,
                    .y_m = y,
                    .dx = static_cast<float>((cx - x) / length),
                    .dy = static_cast<float>((cy - y) / length),
                    .range_max_m = 80.0f});
  }
  std::vector<float> ranges_m(rays.size());
  scene.cast_rays(rays, ranges_m);
  for (std::size_t i = 0; i < rays.size(); ++i) ASSERT_LT(ranges_m[i], 8.0f) << i;
}

TEST(Scene, AnswersTheSameFromManyThreads) {
  const Scene scene(room_at(0.0, 0.0));
  std::vector<Beam> beams;
  beams.reserve(101);
  for (int i = 0; i < 100; ++i) beams.push_back(ray_beam(0.06 * i));
  beams.push_back({.x_m = 0.0, .y_m = 0.0, .theta_rad = 0.0, .half_angle_rad = 0.2, .range_max_m = 80.0});
  const std::vector<Pose> poses(50, Pose{1.0, 1.0, 0.4});
  std::vector<std::vector<float>> answers(4);
  std::vector<std::thread> threads;
  threads.reserve(answers.size());
  for (auto& answer : answers) threads.emplace_back([&] { answer = cast(scene, poses, beams); });
  for (auto& thread : threads) thread.join();
  for (const auto& answer : answers) EXPECT_EQ(answer, cast(scene, poses, beams));
}

// The ranges do not tell whether a scene was made from a grid or from its faces.
TEST(Scene, AGridIsSeenAsItsFacesAre) {
  const std::vector<std::uint8_t> cells{1, 1, 1, 1, 1,  //
                                        1, 0, 0, 0, 1,  //
                                        1, 0, 0, 0, 1,  //
                                        1, 1, 1, 1, 1};
  const std::vector<Segment> faces{{0.0, 3.0, 3.0, 3.0},  {3.0, 3.0, 3.0, 5.0},  // inside
                                   {3.0, 5.0, 0.0, 5.0},  {0.0, 5.0, 0.0, 3.0},
                                   {-1.0, 2.0, 4.0, 2.0}, {4.0, 2.0, 4.0, 6.0},  // outside
                                   {4.0, 6.0, -1.0, 6.0}, {-1.0, 6.0, -1.0, 2.0}};
  const Scene plan(faces);
  int asked = 0;
  const Scene grid({.grid = {.cells = cells, .width_cells = 5, .height_cells = 4},
                    .resolution_m = 1.0,
                    .T_frame_grid = {-1.0, 2.0, 0.0}},
                   [&]() -> std::vector<Segment> {
                     ++asked;
                     return {faces.begin(), faces.end()};
                   });
  EXPECT_EQ(plan.way(), Way::embree);
  EXPECT_EQ(grid.way(), Way::distance_walk);
  std::vector<Beam> beams;
  beams.reserve(40);
  for (int i = 0; i < 40; ++i) beams.push_back(ray_beam(0.11 + 0.157 * i));
  const std::vector<Pose> poses{{0.5, 3.7, 0.3}, {2.3, 4.4, -2.0}, {-0.4, 3.6, 0.1}};  // the last in a wall
  EXPECT_EQ(cast(grid, poses, beams).size(), 120u);
  EXPECT_EQ(asked, 0);
  beams[7].half_angle_rad = beams[23].half_angle_rad = 0.2;
  const std::vector<float> by_cells_m = cast(grid, poses, beams);
  const std::vector<float> by_walls_m = cast(plan, poses, beams);
  for (std::size_t i = 0; i < by_cells_m.size(); ++i) EXPECT_NEAR(by_cells_m[i], by_walls_m[i], 1e-5) << i;
  EXPECT_EQ(asked, 1);
}

TEST(Scene, CountsItsMemory) {
  EXPECT_GT(Scene(room_at(0.0, 0.0)).memory_bytes(), 4 * sizeof(Segment));
}

}  // namespace
}  // namespace landfall::raycast
