#include "kernels/window_tile.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <tuple>

#include "engine/maps/search_tables.hpp"
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
  std::uint64_t blocks = 0;

  Tile(testing::RandomField& random, int points, int reach)
      : width(random.between(1, 200)),
        height(random.between(1, 60)),
        col(block_cells * random.between(0, width / block_cells)),
        row(block_cells * random.between(0, height / block_cells)),
        field(random.bytes(testing::area(width, height))),
        tables(internal::make_window_tables(field, width, height)),
        point_col(random.integers(static_cast<std::size_t>(points), -reach - col, reach + width - col)),
        point_row(random.integers(static_cast<std::size_t>(points), -reach - row, reach + height - row)) {
    const int first_row = random.between(0, tile_rows - 1);
    const int last_row = random.between(first_row, tile_rows - 1);
    for (int lane = first_row * tile_cols; lane < (last_row + 1) * tile_cols; ++lane)
      if (random.between(0, 2) != 0) blocks |= std::uint64_t{1} << lane;
  }

  [[nodiscard]] std::int32_t window_level(int first_col, int first_row) const {
    std::uint8_t most = 0;
    for (int r = std::max(0, first_row); r < std::min(height, first_row + block_cells); ++r)
      for (int c = std::max(0, first_col); c < std::min(width, first_col + block_cells); ++c)
        most = std::max(most, field.data()[r * width + c]);
    return kernels::window_level(most);
  }
  [[nodiscard]] kernels::TilePoints points(Integers& window) const {
    window.resize(point_col.size());
    return kernels::tile_points(tables.maxima(), point_col.data(), point_row.data(), point_col.size(),
                                window.data());
  }
  // Straight from the field.
  [[nodiscard]] Bounds expected() const {
    Bounds bounds{};
    for (int lane = 0; lane < tile_blocks; ++lane)
      for (std::size_t i = 0; i < point_col.size(); ++i)
        bounds[static_cast<std::size_t>(lane)] +=
            window_level(col + lane % tile_cols * block_cells + point_col[i],
                         row + lane / tile_cols * block_cells + point_row[i]);
    return bounds;
  }
  [[nodiscard]] std::int32_t largest(const Bounds& bounds) const {
    std::int32_t most = 0;
    for (std::uint64_t left = blocks; left != 0; left &= left - 1)
      most = std::max(most, bounds[static_cast<std::size_t>(std::countr_zero(left))]);
    return most;
  }
  // Blocks asked for that reach the threshold.
  [[nodiscard]] std::uint64_t reaching(const Bounds& bounds, std::int32_t threshold) const {
    std::uint64_t reach = 0;
    for (std::uint64_t left = blocks; left != 0; left &= left - 1)
      if (bounds[static_cast<std::size_t>(std::countr_zero(left))] >= threshold) reach |= left & (0 - left);
    return reach;
  }
  // What the kernel says of blocks that reach the threshold, and nothing of the others.
  template <class Kernel>
  void expect_exact(const Kernel& kernel, std::int32_t threshold, const Bounds& expected) const {
    Bounds bounds{};
    Integers window;
    const std::uint64_t reach =
        kernel(tables.maxima(), col, row, points(window), threshold, blocks, bounds.data());
    EXPECT_EQ(reach, reaching(expected, threshold)) << point_col.size() << " points, " << threshold;
    for (std::uint64_t left = reach; left != 0; left &= left - 1) {
      const auto block = static_cast<std::size_t>(std::countr_zero(left));
      EXPECT_EQ(bounds[block], expected[block]) << point_col.size() << " points, block " << block;
    }
  }
};

// How far points of a tile may be off the field, in cells.
constexpr std::array<int, 2> reaches{0, 200};

class WindowTile : public ::testing::TestWithParam<std::string> {
 protected:
  testing::UsedInstructionSet used_{GetParam()};
  testing::RandomField random_{8};
};

TEST_P(WindowTile, BoundsEqualTheFieldsMaxima) {
  for (const int points : testing::point_counts) {
    for (const int reach : reaches) {
      const Tile tile(random_, points, reach);
      tile.expect_exact(kernels::bound_windows, 0, tile.expected());
      tile.expect_exact(kernels::scalar::bound_windows, 0, tile.expected());
    }
  }
}

TEST_P(WindowTile, TellsTheBlocksThatReachAThreshold) {
  for (const int points : testing::point_counts) {
    for (const int reach : reaches) {
      const Tile tile(random_, points, reach);
      const Bounds expected = tile.expected();
      const std::int32_t largest = tile.largest(expected);
      for (const std::int32_t threshold :
           {1, largest / 2, largest - 1, largest, largest + 1, 2 * largest + 1, 1 << 30}) {
        tile.expect_exact(kernels::bound_windows, threshold, expected);
        tile.expect_exact(kernels::scalar::bound_windows, threshold, expected);
      }
    }
  }
}

TEST_P(WindowTile, SumsBeyondSixteenBits) {
  testing::RandomField random(9);
  Tile tile(random, 1000, 0);
  tile.field.assign(tile.field.size(), 255);
  tile.tables = internal::make_window_tables(tile.field, tile.width, tile.height);
  std::fill(tile.point_col.begin(), tile.point_col.end(), -tile.col);
  std::fill(tile.point_row.begin(), tile.point_row.end(), -tile.row);
  tile.blocks = ~std::uint64_t{0};
  ASSERT_EQ(tile.expected().front(), 127'000);
  tile.expect_exact(kernels::bound_windows, 127'000, tile.expected());
}

TEST_P(WindowTile, PointsEqualTheirTwin) {
  for (const int count : testing::point_counts) {
    const Tile tile(random_, count, 200);
    Integers window, twin_window(static_cast<std::size_t>(count));
    const kernels::TilePoints points = tile.points(window);
    const kernels::TilePoints twin =
        kernels::scalar::tile_points(tile.tables.maxima(), tile.point_col.data(), tile.point_row.data(),
                                     twin_window.size(), twin_window.data());
    EXPECT_EQ(window, twin_window) << count;
    EXPECT_EQ(std::tie(points.least_col, points.most_col, points.least_row, points.most_row),
              std::tie(twin.least_col, twin.most_col, twin.least_row, twin.most_row))
        << count;
  }
}

TEST(WindowLevels, AreRoundedUp) {
  for (int value = 0; value <= 255; ++value) {
    const int level = kernels::window_level(static_cast<std::uint8_t>(value));
    EXPECT_EQ(level, (value * kernels::window_levels + 254) / 255) << value;
  }
}

TEST(RowByRow, EveryLaneHasItsBit) {
  for (int row = 0; row < tile_rows; ++row)
    for (int col = 0; col < tile_cols; ++col)
      EXPECT_EQ(kernels::row_by_row(std::uint64_t{1} << kernels::tile_lane(col, row)),
                std::uint64_t{1} << (row * tile_cols + col));
  EXPECT_EQ(kernels::row_by_row(~std::uint64_t{0}), ~std::uint64_t{0});
}

INSTANTIATE_TEST_SUITE_P(InstructionSets, WindowTile, ::testing::ValuesIn(testing::instruction_sets()),
                         [](const auto& set) { return set.param; });

}  // namespace
}  // namespace landfall
