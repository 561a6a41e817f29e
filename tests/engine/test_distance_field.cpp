#include "engine/maps/distance_field.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "drawn_map.hpp"
#include "kernels/distance.hpp"
#include "landfall/prepared_map.hpp"
#include "random_world.hpp"

namespace landfall {
namespace {

using Values = std::vector<std::uint8_t>;

std::int32_t squared_by_brute_force(const GridMap& map, CellIndex cell) {
  std::int32_t least = kernels::far_squared;
  for (int row = 0; row < map.height_cells; ++row)
    for (int col = 0; col < map.width_cells; ++col)
      if (map.at({col, row}) == Occupancy::occupied)
        least = std::min(least, (col - cell.col) * (col - cell.col) + (row - cell.row) * (row - cell.row));
  return least;
}

TEST(DistanceField, HoldsSquaredCellsToTheNearestWall) {
  const PreparedMap map(testing::drawn_map({".#..",  //
                                            "....",  //
                                            "?...",  //
                                            "#..."}));
  const std::vector<std::int32_t> expected{0, 1, 4, 9,  // the lowest row first
                                           1, 2, 5, 8,  //
                                           2, 1, 2, 5,  //
                                           1, 0, 1, 4};
  EXPECT_TRUE(std::ranges::equal(map.squared_distance_cells(), expected));
}

TEST(DistanceField, IsFarWhereNothingIsOccupied) {
  const PreparedMap map(testing::drawn_map({"..", "?."}));
  for (const std::int32_t squared : map.squared_distance_cells()) EXPECT_EQ(squared, std::int32_t{1} << 30);
  for (const std::uint8_t value : map.field()) EXPECT_EQ(value, 0);
}

TEST(DistanceField, EqualsBruteForce) {
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    testing::Dice dice(seed, 20);
    const PreparedMap map(testing::random_map(dice, 1, 70));
    const GridMap& grid = map.grid();
    for (int row = 0; row < grid.height_cells; ++row)
      for (int col = 0; col < grid.width_cells; ++col)
        ASSERT_EQ(map.squared_distance_cells()[grid.index({col, row})],
                  squared_by_brute_force(grid, {col, row}))
            << "seed " << seed << ", col " << col << ", row " << row;
  }
}

// 255 exp(-d^2 / (2 (0.1 m)^2)) at 0, 0.05, 0.1, 0.15 m: 255, 225.04, 154.66, 82.79.
TEST(LikelihoodField, IsAGaussianOfTheDistance) {
  EXPECT_EQ(internal::likelihood_field(testing::drawn_map({"#..."}, 0.05), 0.1, 0),
            (Values{255, 225, 155, 83}));
}

TEST(LikelihoodField, UnknownCellsHaveALeastValue) {
  EXPECT_EQ(internal::likelihood_field(testing::drawn_map({"#??."}, 0.05), 0.1, 200),
            (Values{255, 225, 200, 83}));
}

// Both transforms behind it: windowed for narrow fields, exact for wide ones (0.8 m: 56 cells).
TEST(LikelihoodField, EqualsItsFormulaForAnyWidth) {
  for (const double sigma_m : {0.001, 0.05, 0.1, 0.3, 0.68, 0.8, 2.0, 50.0}) {
    testing::Dice dice(21);
    GridMap grid = testing::random_map(dice, 60, 90);
    grid.resolution_m = 0.05;
    const Values field = internal::likelihood_field(grid, sigma_m, 0);
    for (int row = 0; row < grid.height_cells; row += 3) {
      for (int col = 0; col < grid.width_cells; ++col) {
        const double d_m = std::sqrt(squared_by_brute_force(grid, {col, row})) * grid.resolution_m;
        const double expected = 255.0 * std::exp(-d_m * d_m / (2.0 * sigma_m * sigma_m));
        ASSERT_NEAR(field[grid.index({col, row})], expected, 0.5 + 1e-9)
            << "sigma " << sigma_m << ", col " << col << ", row " << row;
      }
    }
  }
}

}  // namespace
}  // namespace landfall
