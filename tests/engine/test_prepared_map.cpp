#include "landfall/prepared_map.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "drawn_map.hpp"
#include "engine/maps/prepared_state.hpp"
#include "landfall/error.hpp"
#include "rooms.hpp"

namespace landfall {
namespace {

TEST(PreparedMap, PartsAreBuiltOnFirstNeedAndKept) {
  const PreparedMap map(testing::furnished_room());
  const std::size_t bare = map.memory_bytes();
  EXPECT_GE(bare, 80u * 60u);
  const std::uint8_t* field = map.field().data();
  const std::size_t with_field = map.memory_bytes();
  EXPECT_GE(with_field, bare + 80u * 60u);
  EXPECT_EQ(map.field().data(), field);
  EXPECT_EQ(map.memory_bytes(), with_field);
  map.prepare();
  EXPECT_GT(map.memory_bytes(), with_field);
  EXPECT_EQ(map.field().data(), field);
}

TEST(PreparedMap, CopiesShareTheirParts) {
  const PreparedMap map(testing::furnished_room());
  const PreparedMap copy = map;  // NOLINT(performance-unnecessary-copy-initialization)
  EXPECT_EQ(copy.field().data(), map.field().data());
  EXPECT_EQ(&copy.grid(), &map.grid());
}

TEST(PreparedMap, KeepsTheGridAndOptionsItWasGiven) {
  const GridMap grid = testing::furnished_room({1.0, 2.0, 0.3});
  const PreparedMap map(grid, {.field_sigma_m = 0.2, .unknown_value = 7, .name = "room"});
  EXPECT_EQ(map.grid(), grid);
  EXPECT_EQ(map.options().name, "room");
  EXPECT_EQ(map.options().unknown_value, 7);
}

TEST(PreparedMap, APlanKeepsItsOwnWalls) {
  const WallMap plan{.walls = {{{0.0, 0.0}, {3.0, 0.0}}, {{3.0, 0.0}, {3.0, 2.0}}}};
  const PreparedMap map(plan, {.resolution_m = 0.25, .margin_m = 0.5});
  EXPECT_EQ(map.walls(), plan);
  EXPECT_EQ(map.grid().resolution_m, 0.25);
  EXPECT_EQ(map.grid(), to_grid(plan, {.resolution_m = 0.25, .margin_m = 0.5}));
}

TEST(PreparedMap, AGridsWallsAreItsMergedFaces) {
  const GridMap grid = testing::furnished_room();
  EXPECT_EQ(PreparedMap(grid).walls(), to_walls(grid));
}

TEST(PreparedMap, RefusesWhatCannotBePrepared) {
  EXPECT_THROW(PreparedMap{GridMap{}}, Error);
  EXPECT_THROW(PreparedMap{WallMap{}}, Error);
  GridMap no_resolution = testing::furnished_room();
  no_resolution.resolution_m = 0.0;
  EXPECT_THROW(PreparedMap{no_resolution}, Error);
  // So far out that the numbers of a pose step over cells; map frames of whole countries are fine.
  GridMap far = testing::furnished_room();
  far.T_map_grid.x_m = 1e8;
  EXPECT_NO_THROW(PreparedMap{far});
  far.T_map_grid.x_m = 1e18;
  EXPECT_THROW(PreparedMap{far}, Error);
  for (const double sigma_m :
       {0.0, -0.1, 1e6, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    try {
      const PreparedMap map(testing::furnished_room(), {.field_sigma_m = sigma_m, .name = {}});
      FAIL() << "no error for " << sigma_m;
    } catch (const Error& error) {
      EXPECT_THAT(error.what(), ::testing::HasSubstr("field_sigma_m"));
    }
  }
}

TEST(GridMap, PointsHoweverFarHaveACellOutside) {
  const GridMap grid = testing::empty_map(8, 6, 0.5, {1.0, 2.0, 0.0});
  EXPECT_EQ(grid.cell_of({1.2, 4.9}), (CellIndex{.col = 0, .row = 5}));
  EXPECT_EQ(grid.cell_of({0.9, 5.1}), (CellIndex{.col = -1, .row = 6}));
  const CellIndex far = grid.cell_of({1e12, -1e300});
  EXPECT_GT(far.col, grid.width_cells);
  EXPECT_LT(far.row, 0);
  EXPECT_FALSE(grid.contains(grid.cell_of({std::numeric_limits<double>::quiet_NaN(), 3.0})));
}

TEST(FreeMask, HoldsFreeCellsOfTheStep) {
  const PreparedMap map(testing::drawn_map({"..?..",  //
                                            ".....",  //
                                            "..#.."}));
  const auto mask = map.state().free_mask(0.0, 1);
  EXPECT_EQ(mask->count(), 13);
  EXPECT_TRUE(mask->contains(1, 0));
  EXPECT_FALSE(mask->contains(2, 0));
  EXPECT_FALSE(mask->contains(2, 2));
  EXPECT_EQ(map.state().free_mask(0.0, 2)->count(),
            4);  // columns 0, 2, 4 of rows 0, 2, without (2, 0) and (2, 2)
  EXPECT_EQ(map.state().free_mask(0.0, 1), mask);
}

// One corner of the map alone: distances by hand.
TEST(FreeMask, ARadiusClearsTheDiscsSurroundings) {
  GridMap grid = testing::empty_map(40, 40, 0.5);
  testing::fill(grid, {20, 20}, {20, 20}, Occupancy::occupied);
  const PreparedMap map(grid);
  const auto mask = map.state().free_mask(1.6, 1);  // 3.2 cells
  EXPECT_FALSE(mask->contains(17, 20));             // 3 cells
  EXPECT_FALSE(mask->contains(18, 18));             // 2.83
  EXPECT_TRUE(mask->contains(17, 18));              // 3.61
  EXPECT_TRUE(mask->contains(16, 20));              // 4
}

}  // namespace
}  // namespace landfall
