#include "kernels/window_tile.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "engine/search_tables.hpp"
#include "instruction_sets.hpp"
#include "random_field.hpp"

namespace landfall {
namespace {

using kernels::block_cells;
using kernels::tile_blocks;
using kernels::tile_cols;
using kernels::tile_rows;
using Integers = std::vector<std::int32_t>;
using Bounds = std::array<std::int32_t, tile_blocks>;

// A random field, a tile of blocks on it, and points that reach beyond it.
struct Tile {
  int width, height, col, row;
  std::vector<std::uint8_t> field;
  internal::WindowTables tables;
  Integers point_col, point_row;
  std::array<std::uint16_t, tile_blocks> counted{};

  Tile(testing::RandomField& random, int points)
      : width(random.between(1, 200)),
        height(random.between(1, 60)),
        col(block_cells * random.between(0, width / block_cells)),
        row(block_cells * random.between(0, height / block_cells)),
        field(random.bytes(testing::area(width, height))),
        tables(internal::make_window_tables(field, width, height)),
        point_col(random.integers(static_cast<std::size_t>(points), -width - 200, width + 200)),
        point_row(random.integers(static_cast<std::size_t>(points), -height - 80, height + 80)) {
    const int first_row = random.between(0, tile_rows - 1);
    const int last_row = random.between(first_row, tile_rows - 1);
    for (int lane = first_row * tile_cols; lane < (last_row + 1) * tile_cols; ++lane)
      counted[static_cast<std::size_t>(lane)] =
          random.between(0, 2) == 0 ? std::uint16_t{0} : std::uint16_t{0xFFFF};
  }

  [[nodiscard]] std::int32_t window_max(int first_col, int first_row) const {
    std::int32_t most = 0;
    for (int r = std::max(0, first_row); r < std::min(height, first_row + block_cells); ++r)
      for (int c = std::max(0, first_col); c < std::min(width, first_col + block_cells); ++c)
        most = std::max<std::int32_t>(most, field.data()[r * width + c]);
    return most;
  }
  // Straight from the field.
  [[nodiscard]] Bounds expected() const {
    Bounds bounds{};
    for (int lane = 0; lane < tile_blocks; ++lane)
      for (std::size_t i = 0; i < point_col.size(); ++i)
        bounds[static_cast<std::size_t>(lane)] +=
            window_max(col + lane % tile_cols * block_cells + point_col[i],
                       row + lane / tile_cols * block_cells + point_row[i]);
    return counted_of(bounds);
  }
  [[nodiscard]] std::int32_t largest(const Bounds& bounds) const {
    std::int32_t most = 0;
    for (std::size_t lane = 0; lane < bounds.size(); ++lane)
      if (counted[lane] != 0) most = std::max(most, bounds[lane]);
    return most;
  }
  // Without what is not counted.
  [[nodiscard]] Bounds counted_of(Bounds bounds) const {
    for (std::size_t lane = 0; lane < bounds.size(); ++lane)
      if (counted[lane] == 0) bounds[lane] = 0;
    return bounds;
  }
  template <class Kernel>
  bool run(const Kernel& kernel, std::int32_t threshold, Bounds& bounds) const {
    return kernel(tables.maxima(), col, row, point_col.data(), point_row.data(), point_col.size(), threshold,
                  counted.data(), bounds.data());
  }
};

class WindowTile : public ::testing::TestWithParam<std::string> {
 protected:
  testing::UsedInstructionSet used_{GetParam()};
  testing::RandomField random_{8};
};

TEST_P(WindowTile, BoundsEqualTheFieldsMaxima) {
  for (const int points : testing::point_counts) {
    const Tile tile(random_, points);
    Bounds bounds{}, twin{};
    ASSERT_TRUE(tile.run(kernels::bound_windows, 0, bounds)) << points;
    ASSERT_TRUE(tile.run(kernels::scalar::bound_windows, 0, twin)) << points;
    EXPECT_EQ(tile.counted_of(bounds), tile.expected()) << points;
    EXPECT_EQ(tile.counted_of(twin), tile.expected()) << points;
  }
}

TEST_P(WindowTile, GivesUpOnlyWhereNoCountedBlockReachesTheThreshold) {
  for (const int points : testing::point_counts) {
    const Tile tile(random_, points);
    const Bounds expected = tile.expected();
    const std::int32_t largest = tile.largest(expected);
    for (const std::int32_t threshold : {largest / 2, largest - 1, largest}) {
      Bounds bounds{};
      ASSERT_TRUE(tile.run(kernels::bound_windows, threshold, bounds)) << points;
      EXPECT_EQ(tile.counted_of(bounds), expected) << points;
    }
    for (const std::int32_t threshold : {largest + 1, 2 * largest + 1, 1 << 30}) {
      Bounds bounds{};
      EXPECT_FALSE(tile.run(kernels::bound_windows, threshold, bounds)) << points;
      EXPECT_FALSE(tile.run(kernels::scalar::bound_windows, threshold, bounds)) << points;
    }
  }
}

TEST_P(WindowTile, SumsBeyondSixteenBits) {
  testing::RandomField random(9);
  Tile tile(random, 1000);
  tile.field.assign(tile.field.size(), 255);
  tile.tables = internal::make_window_tables(tile.field, tile.width, tile.height);
  std::fill(tile.point_col.begin(), tile.point_col.end(), -tile.col);
  std::fill(tile.point_row.begin(), tile.point_row.end(), -tile.row);
  tile.counted.fill(0xFFFF);
  Bounds bounds{};
  ASSERT_TRUE(tile.run(kernels::bound_windows, 255'000, bounds));
  EXPECT_EQ(bounds.front(), 255'000);
  EXPECT_EQ(bounds, tile.expected());
}

INSTANTIATE_TEST_SUITE_P(InstructionSets, WindowTile, ::testing::ValuesIn(testing::instruction_sets()),
                         [](const auto& set) { return set.param; });

}  // namespace
}  // namespace landfall
