#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include "raycast/segment_tree.hpp"

namespace landfall::raycast {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double pi = std::numbers::pi;

double nearest(const std::vector<Segment>& walls, double theta_rad, double half_angle_rad,
               double range_max_m = 80.0) {
  return nearest_in_cone(walls, {.x_m = 0.0,
                                 .y_m = 0.0,
                                 .theta_rad = theta_rad,
                                 .half_angle_rad = half_angle_rad,
                                 .range_max_m = range_max_m});
}

TEST(Cone, SeesTheFootOfThePerpendicularWhereItLiesWithin) {
  const std::vector<Segment> wall{{2.0, -5.0, 2.0, 5.0}};
  EXPECT_NEAR(nearest(wall, 0.0, 0.1), 2.0, 1e-12);
  EXPECT_NEAR(nearest(wall, 0.09, 0.1), 2.0, 1e-12);
  // Turned away by more than its half-angle: the cone's edge, at 0.5 - 0.1 rad, meets the wall first.
  EXPECT_NEAR(nearest(wall, 0.5, 0.1), 2.0 / std::cos(0.4), 1e-12);
}

TEST(Cone, SeesAWallThatEndsWithinIt) {
  const std::vector<Segment> post{{3.0, 0.2, 9.0, 0.2}};
  EXPECT_NEAR(nearest(post, 0.0, 0.1), std::hypot(3.0, 0.2), 1e-12);
  EXPECT_NEAR(nearest(post, 0.0, 0.05), std::hypot(0.2 / std::tan(0.05), 0.2), 1e-9);  // cut by the edge
  EXPECT_EQ(nearest(post, 0.0, 0.02), infinity);  // reaches 0.18 m aside at x = 9
}

TEST(Cone, LooksForwardOnlyAndNoFurtherThanItsRange) {
  const std::vector<Segment> wall{{2.0, -5.0, 2.0, 5.0}};
  EXPECT_EQ(nearest(wall, pi, 0.3), infinity);
  EXPECT_EQ(nearest(wall, 0.0, 0.1, 1.9), infinity);
  EXPECT_NEAR(nearest(wall, 0.0, 0.1, 2.0), 2.0, 1e-12);
}

TEST(Cone, MayBeWiderThanAHalfPlane) {
  const std::vector<Segment> behind{{-1.0, 0.5, -1.0, 3.0}, {5.0, -9.0, 5.0, 9.0}};
  EXPECT_NEAR(nearest(behind, 0.0, 0.4 * pi), 5.0, 1e-12);
  EXPECT_NEAR(nearest(behind, 0.0, 0.9 * pi), std::hypot(1.0, 0.5), 1e-12);
  EXPECT_NEAR(nearest(behind, pi, 0.99 * pi), std::hypot(1.0, 0.5), 1e-12);
}

TEST(Cone, AWallOfNoLengthIsAPoint) {
  EXPECT_NEAR(nearest({{3.0, 4.0, 3.0, 4.0}}, std::atan2(4.0, 3.0), 0.01), 5.0, 1e-12);
}

// A dense fan of points along each wall bounds the minimum from above, and by its spacing from below.
TEST(Cone, EqualsTheNearestOfManySampledPoints) {
  std::mt19937 rng(3);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (int n = 0; n < 300; ++n) {
    const Segment wall{5.0 * uniform(rng), 5.0 * uniform(rng), 5.0 * uniform(rng), 5.0 * uniform(rng)};
    const double theta_rad = pi * uniform(rng);
    const double half_angle_rad = 0.5 * pi * std::abs(uniform(rng)) + 0.01;
    double sampled_m = infinity;
    for (int i = 0; i <= 20'000; ++i) {
      const double x = wall.ax_m + (wall.bx_m - wall.ax_m) * i / 20'000.0;
      const double y = wall.ay_m + (wall.by_m - wall.ay_m) * i / 20'000.0;
      if (std::abs(std::remainder(std::atan2(y, x) - theta_rad, 2.0 * pi)) <= half_angle_rad)
        sampled_m = std::min(sampled_m, std::hypot(x, y));
    }
    const double exact_m = nearest({wall}, theta_rad, half_angle_rad);
    if (sampled_m == infinity) continue;  // a sliver between two samples may still be seen
    EXPECT_LE(exact_m, sampled_m + 1e-12);
    EXPECT_NEAR(exact_m, sampled_m, 1e-3);
  }
}

TEST(SegmentTree, EqualsTheMinimumOverAllWalls) {
  std::mt19937 rng(5);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  int seen = 0;
  for (const std::size_t count : {0u, 1u, 4u, 5u, 33u, 700u}) {
    std::vector<Segment> walls;
    for (std::size_t i = 0; i < count; ++i) {
      const double x = 20.0 * uniform(rng);
      const double y = 20.0 * uniform(rng);
      walls.push_back({x, y, x + uniform(rng), y + uniform(rng)});
    }
    const SegmentTree tree(walls);
    for (int n = 0; n < 500; ++n) {
      const Cone cone{.x_m = 22.0 * uniform(rng),
                      .y_m = 22.0 * uniform(rng),
                      .theta_rad = 10.0 * uniform(rng),
                      .half_angle_rad = (n % 2 == 0 ? 0.999 * pi : 0.3) * std::abs(uniform(rng)),
                      .range_max_m = n % 3 == 0 ? 3.0 : 100.0};
      const double expected_m = nearest_in_cone(walls, cone);
      EXPECT_EQ(tree.nearest_in_cone(cone), expected_m);
      seen += expected_m < infinity;
    }
  }
  EXPECT_GT(seen, 500);
}

}  // namespace
}  // namespace landfall::raycast
