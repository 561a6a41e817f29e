#include "kernels/bound_tile.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>

#include "instruction_sets.hpp"
#include "random_field.hpp"

namespace landfall {
namespace {

using kernels::tile_blocks;
using kernels::tile_cols;
using kernels::tile_rows;
using Integers = std::vector<std::int32_t>;
using Sums = std::array<std::uint16_t, tile_blocks>;

// Planes of random levels, and points of random weights as lists of their bits.
struct Tile {
  int cols, rows;
  std::vector<std::uint8_t> levels;
  Integers plane, col, row, list_end;
  int tile_col, tile_row;

  static constexpr int planes_kept = 3;

  Tile(testing::RandomField& random, int points, int heaviest, int most_level = kernels::bound_levels)
      : cols(tile_cols + random.between(0, 90)), rows(tile_rows + random.between(0, 30)) {
    levels = random.bytes(testing::area(planes_kept * cols, rows), most_level);
    const auto count = static_cast<std::size_t>(points);
    const Integers weights = random.integers(count, 1, heaviest);
    const Integers planes_of = random.integers(count, 0, planes_kept - 1);
    const Integers cols_of = random.integers(count, -cols, cols);
    const Integers rows_of = random.integers(count, -rows, rows);
    for (int bit = static_cast<int>(std::bit_width(static_cast<unsigned>(heaviest))) - 1; bit >= 0; --bit) {
      for (std::size_t i = 0; i < count; ++i) {
        if (((weights[i] >> bit) & 1) == 0) continue;
        plane.push_back(planes_of[i] * cols * rows);
        col.push_back(cols_of[i]);
        row.push_back(rows_of[i]);
      }
      list_end.push_back(static_cast<std::int32_t>(plane.size()));
    }
    tile_col = random.between(-10, cols);
    tile_row = random.between(-10, rows);
  }

  [[nodiscard]] kernels::BoundPlanes planes() const {
    return {
        .data = levels.data(), .stride = cols, .last_col = cols - tile_cols, .last_row = rows - tile_rows};
  }
  [[nodiscard]] kernels::BoundPoints points() const {
    return {.plane = plane.data(),
            .col = col.data(),
            .row = row.data(),
            .list_end = list_end.data(),
            .lists = static_cast<std::int32_t>(list_end.size())};
  }
  bool bound(int threshold, Sums& sums) const {
    Integers scratch(plane.size() + 1);
    return kernels::bound_tile(planes(), points(), tile_col, tile_row, threshold, scratch.data(),
                               sums.data());
  }
  [[nodiscard]] Sums twin() const {
    Sums sums{};
    kernels::scalar::bound_tile(planes(), points(), tile_col, tile_row, 0, nullptr, sums.data());
    return sums;
  }
};

// The twin by hand: three points, of weight 1, 2 and 3, over one plane that counts its own bytes.
TEST(BoundTileByHand, WeighsPointsByTheirLists) {
  constexpr int cols = tile_cols + 2;
  std::vector<std::uint8_t> levels(testing::area(cols, tile_rows + 2));
  for (std::size_t i = 0; i < levels.size(); ++i) levels[i] = static_cast<std::uint8_t>(i % 7);
  const Integers plane(4, 0);
  const Integers col{1, 2, 0, 2};  // list of 2: b, c; list of 1: a, c
  const Integers row{0, 1, 0, 1};
  const Integers list_end{2, 4};
  Sums sums{};
  EXPECT_TRUE(kernels::scalar::bound_tile(
      {.data = levels.data(), .stride = cols, .last_col = 2, .last_row = 2},
      {.plane = plane.data(), .col = col.data(), .row = row.data(), .list_end = list_end.data(), .lists = 2},
      0, 0, 1, nullptr, sums.data()));
  // Block (col 3, row 1): a at (0, 0), weight 1; b at (1, 0), weight 2; c at (2, 1), weight 3.
  const auto level = [](int c, int r) { return (r * cols + c) % 7; };
  EXPECT_EQ(sums[tile_cols + 3], level(3, 1) + 2 * level(4, 1) + 3 * level(5, 2));
}

class BoundTile : public ::testing::TestWithParam<std::string> {
 protected:
  testing::UsedInstructionSet used_{GetParam()};
  testing::RandomField random_{4};
};

TEST_P(BoundTile, EqualsItsTwin) {
  for (const int points : testing::point_counts) {
    for (const int heaviest : {1, 2, 3, 7, 8, 20}) {
      const Tile tile(random_, points, heaviest);
      Sums sums{};
      ASSERT_TRUE(tile.bound(0, sums));
      EXPECT_EQ(sums, tile.twin()) << points << " points up to weight " << heaviest;
    }
  }
}

TEST_P(BoundTile, GivesUpOnlyWhereNoBlockReachesTheThreshold) {
  for (const int points : testing::point_counts) {
    if (points == 0) continue;  // it looks after points alone
    const Tile tile(random_, points, 5);
    const Sums expected = tile.twin();
    const int largest = *std::max_element(expected.begin(), expected.end());
    for (const int threshold : {0, largest / 2, largest}) {
      Sums sums{};
      ASSERT_TRUE(tile.bound(threshold, sums)) << points << " points, " << threshold << " of " << largest;
      EXPECT_EQ(sums, expected);
    }
    Sums sums{};
    EXPECT_FALSE(tile.bound(largest + 1, sums)) << points;
  }
}

TEST_P(BoundTile, SaturatesAtSixteenBits) {
  Tile tile(random_, 300, 30, 31);
  std::fill(tile.levels.begin(), tile.levels.end(), std::uint8_t{31});
  Sums full{};
  full.fill(65535);
  Sums sums{};
  ASSERT_TRUE(tile.bound(65535, sums));
  EXPECT_EQ(sums, full);
  EXPECT_EQ(tile.twin(), full);
}

// Some blocks saturated, some not: sums of large weights over levels of few kinds.
TEST_P(BoundTile, EqualsItsTwinAroundSaturation) {
  for (const int points : {60, 257, 1000}) {
    const Tile tile(random_, points, 255);
    Sums sums{};
    ASSERT_TRUE(tile.bound(0, sums));
    EXPECT_EQ(sums, tile.twin()) << points;
  }
}

INSTANTIATE_TEST_SUITE_P(InstructionSets, BoundTile, ::testing::ValuesIn(testing::instruction_sets()),
                         [](const auto& set) { return set.param; });

}  // namespace
}  // namespace landfall
