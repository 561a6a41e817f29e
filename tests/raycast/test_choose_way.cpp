#include "raycast/choose_way.hpp"

#include <gtest/gtest.h>

#include "raycast/distance_walk.hpp"

namespace landfall::raycast {
namespace {

TEST(ChooseWay, TakesFreeSquaresOnGridsAndWallsOnPlans) {
  for (const Pattern pattern : {Pattern::fan, Pattern::single_rays}) {
    EXPECT_EQ(choose_way({.grid_cells = 1}, pattern), Way::distance_walk);
    EXPECT_EQ(choose_way({.grid_cells = 4800 * 4120}, pattern), Way::distance_walk);
    EXPECT_EQ(choose_way({.grid_cells = 0}, pattern), Way::embree);
  }
}

TEST(ChooseWay, CastsConesAtWalls) {
  EXPECT_EQ(choose_way({.grid_cells = 100}, Pattern::cones), Way::segment_tree);
  EXPECT_EQ(choose_way({.grid_cells = 0}, Pattern::cones), Way::segment_tree);
}

// Sizes with the longest border that a map may have, and the shortest.
TEST(ChooseWay, NeverTakesATableThatCannotBeHeld) {
  for (const int width_cells : {8'259, 23'000, 65'000}) {
    int chosen = 0;
    for (int height_cells = 8'000; height_cells <= 65'000; ++height_cells) {
      if (choose_way({.grid_cells = std::int64_t{width_cells} * height_cells}, Pattern::fan) !=
          Way::distance_walk)
        continue;
      ++chosen;
      EXPECT_TRUE(
          DistanceWalk::can_hold({.cells = {}, .width_cells = width_cells, .height_cells = height_cells}));
    }
    EXPECT_GT(chosen, 0);
  }
  EXPECT_EQ(choose_way({.grid_cells = std::int64_t{1} << 30}, Pattern::fan), Way::embree);
}

TEST(ChooseWay, NamesAllWays) {
  EXPECT_EQ(name(Way::embree), "embree");
  EXPECT_EQ(name(Way::distance_walk), "distance_walk");
  EXPECT_EQ(name(Way::segment_tree), "segment_tree");
}

}  // namespace
}  // namespace landfall::raycast
