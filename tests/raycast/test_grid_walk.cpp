#include "raycast/grid_walk.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include "drawn_map.hpp"
#include "grid_oracle.hpp"

namespace landfall {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double pi = std::numbers::pi;

// Row 0 is the bottom line. Free inside: [1, 5] x [1, 3].
const GridMap room = testing::drawn_map({"######",  //
                                         "#....#",  //
                                         "#..#.#",  //
                                         "######"});

double walk(const GridMap& map, double x, double y, double theta_rad, double range_max = infinity) {
  return raycast::walk_grid(testing::grid_view(map), x, y, std::cos(theta_rad), std::sin(theta_rad),
                            range_max);
}

TEST(GridWalk, StopsAtTheFaceWhereItEntersAnOccupiedCell) {
  EXPECT_NEAR(walk(room, 1.5, 1.5, 0.0), 1.5, 1e-12);        // the pillar's face at x = 3
  EXPECT_NEAR(walk(room, 1.5, 2.5, 0.0), 3.5, 1e-12);        // above the pillar, the wall at x = 5
  EXPECT_NEAR(walk(room, 1.5, 1.25, pi), 0.5, 1e-12);        // the wall at x = 1
  EXPECT_NEAR(walk(room, 1.5, 1.25, pi / 2), 1.75, 1e-12);   // the wall at y = 3
  EXPECT_NEAR(walk(room, 1.5, 1.25, -pi / 2), 0.25, 1e-12);  // the wall at y = 1
  EXPECT_NEAR(walk(room, 1.5, 1.25, pi / 4), std::sqrt(2.0) * 1.75, 1e-12);  // x = 3 at y = 2.75: on to y = 3
}

TEST(GridWalk, PassesNothingCloserThanItsRange) {
  EXPECT_EQ(walk(room, 1.5, 2.5, 0.0, 3.4), infinity);
  EXPECT_NEAR(walk(room, 1.5, 2.5, 0.0, 3.6), 3.5, 1e-12);
}

TEST(GridWalk, IsZeroWhereItStartsInAnOccupiedCell) {
  EXPECT_EQ(walk(room, 3.5, 1.5, 1.0), 0.0);
}

TEST(GridWalk, EntersTheGridFromOutside) {
  EXPECT_NEAR(walk(room, -7.0, 2.5, 0.0), 7.0, 1e-12);
  EXPECT_NEAR(walk(room, 3.5, 104.0, -pi / 2), 100.0, 1e-9);
  EXPECT_EQ(walk(room, -7.0, 2.5, pi), infinity);
  EXPECT_EQ(walk(room, -7.0, 9.0, 0.0), infinity);
}

TEST(GridWalk, LeavesTheGridWithoutAnEcho) {
  const GridMap open = testing::drawn_map({"..", ".."});
  EXPECT_EQ(walk(open, 0.5, 0.5, 0.3), infinity);
}

TEST(GridWalk, UnknownCellsStopNothing) {
  const GridMap map = testing::drawn_map({".??#"});
  EXPECT_NEAR(walk(map, 0.5, 0.5, 0.0), 2.5, 1e-12);
}

// Every cell that a fine sampling of the ray touches is visited, in order, and no other but those that the
// sampling steps over near a corner.
TEST(CellWalk, VisitsTheCellsThatTheRayPasses) {
  std::mt19937 rng(7);
  std::uniform_real_distribution<double> uniform(-3.0, 3.0);
  for (int n = 0; n < 200; ++n) {
    const double x = uniform(rng);
    const double y = uniform(rng);
    const double theta_rad = uniform(rng);
    const double dx = std::cos(theta_rad);
    const double dy = std::sin(theta_rad);
    raycast::CellWalk walk(x, y, dx, dy);
    for (double t = 0.0; t < 10.0; t += 0.01) {
      while (walk.leaves() <= t) walk.step();
      const double in_x = x + t * dx - walk.col();
      const double in_y = y + t * dy - walk.row();
      EXPECT_GE(in_x, -1e-9);
      EXPECT_LE(in_x, 1.0 + 1e-9);
      EXPECT_GE(in_y, -1e-9);
      EXPECT_LE(in_y, 1.0 + 1e-9);
    }
  }
}

}  // namespace
}  // namespace landfall
