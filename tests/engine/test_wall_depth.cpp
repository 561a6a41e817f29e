#include "engine/maps/wall_depth.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "rooms.hpp"

namespace landfall {
namespace {

using internal::ends_within_wall;

// Free up to x = 2, a wall from there to x = 2.4, free beyond; a solid block from x = 4 on. Cells of 10 cm.
GridMap thick_walls(const Pose2& T_map_grid = {}) {
  GridMap grid = testing::empty_map(80, 20, 0.1, T_map_grid);
  testing::fill(grid, {20, 0}, {23, 19}, Occupancy::occupied);
  testing::fill(grid, {40, 0}, {79, 19}, Occupancy::occupied);
  return grid;
}

const Pose2 eastward{1.0, 1.0, 0.0};
constexpr double face_m = 1.0;  // range of the first wall's face

TEST(WallDepth, AnEchoBetweenTheFacesOfAWallEndsInIt) {
  for (const double range_m : {1.05, 1.1, 1.2, 1.35})
    EXPECT_TRUE(ends_within_wall(thick_walls(), eastward, face_m, range_m)) << range_m;
}

TEST(WallDepth, AnEchoFromBehindAWallDoesNot) {
  for (const double range_m : {1.5, 1.8, 2.5, 3.1})
    EXPECT_FALSE(ends_within_wall(thick_walls(), eastward, face_m, range_m)) << range_m;
}

// Less than half a cell is looked at no closer: what counts is where the stretch ends.
TEST(WallDepth, AShortStretchEndsInTheWallOrNot) {
  EXPECT_TRUE(ends_within_wall(thick_walls(), eastward, face_m, face_m + 0.02));
  EXPECT_FALSE(ends_within_wall(thick_walls(), eastward, 1.39, 1.42));
  EXPECT_FALSE(ends_within_wall(thick_walls(), eastward, 0.5, 0.52));
}

TEST(WallDepth, SolidsAreNotEntered) {
  const Pose2 before_the_block{3.0, 1.0, 0.0};
  EXPECT_TRUE(ends_within_wall(thick_walls(), before_the_block, face_m, 1.25));
  EXPECT_FALSE(ends_within_wall(thick_walls(), before_the_block, face_m, 1.45));
  EXPECT_FALSE(ends_within_wall(thick_walls(), before_the_block, face_m, 3.0));
}

TEST(WallDepth, GrazingBeamsStayInAWallForLong) {
  // 10 degrees to the wall along x = 2: its 0.4 m are 2.3 m along the beam.
  const double to_wall_rad = std::numbers::pi / 18.0;
  const Pose2 grazing{1.95, 0.05, std::numbers::pi / 2.0 - to_wall_rad};
  const double face = 0.05 / std::sin(to_wall_rad);
  EXPECT_TRUE(ends_within_wall(thick_walls(), grazing, face, face + 1.0));
}

TEST(WallDepth, RotatedGridsAreTheSame) {
  const Pose2 T_map_grid{7.0, -3.0, 0.7};
  EXPECT_TRUE(ends_within_wall(thick_walls(T_map_grid), T_map_grid * eastward, face_m, 1.25));
  EXPECT_FALSE(ends_within_wall(thick_walls(T_map_grid), T_map_grid * eastward, face_m, 1.55));
}

}  // namespace
}  // namespace landfall
