#include "raycast/choose_way.hpp"

#include <gtest/gtest.h>

namespace landfall::raycast {
namespace {

TEST(ChooseWay, TakesFreeSquaresOnGridsAndWallsOnPlans) {
  EXPECT_EQ(choose_way({.width_cells = 1, .height_cells = 1}), Way::distance_walk);
  EXPECT_EQ(choose_way({.width_cells = 4800, .height_cells = 4120}), Way::distance_walk);
  EXPECT_EQ(choose_way({}), Way::embree);
}

// With the ring around it: (width + 2) (height + 2) < 2^29, which is 8192 x 65536 and 3 x 178 956 970.67.
TEST(ChooseWay, TakesFreeSquaresAsFarAsTheirTableCanBeHeld) {
  const auto way = [](int width_cells, int height_cells) {
    return choose_way({.width_cells = width_cells, .height_cells = height_cells});
  };
  EXPECT_EQ(way(8190, 65'533), Way::distance_walk);
  EXPECT_EQ(way(8190, 65'534), Way::embree);
  EXPECT_EQ(way(1, 178'956'968), Way::distance_walk);
  EXPECT_EQ(way(1, 178'956'969), Way::embree);
  EXPECT_EQ(way(1, 400'000'000), Way::embree);  // its cells alone could be counted
  EXPECT_EQ(way(400'000'000, 1), Way::embree);
  EXPECT_EQ(way(2'147'483'647, 2'147'483'647), Way::embree);
}

TEST(ChooseWay, NamesAllWays) {
  EXPECT_EQ(name(Way::embree), "embree");
  EXPECT_EQ(name(Way::distance_walk), "distance_walk");
  EXPECT_EQ(name(Way::segment_tree), "segment_tree");
}

}  // namespace
}  // namespace landfall::raycast
