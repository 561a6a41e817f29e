// The tables of the bounds against naive maxima: no entry may be smaller.
#include "engine/maps/search_tables.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "random_world.hpp"

namespace landfall {
namespace {

using internal::BoundTable;
using internal::WindowTables;
using kernels::block_cells;

struct Field {
  int width, height;
  std::vector<std::uint8_t> values;

  // The maximum over the cells [col, col + size) x [row, row + size); 0 off the map.
  [[nodiscard]] int window_max(int col, int row, int size) const {
    int most = 0;
    for (int r = std::max(0, row); r < std::min(height, row + size); ++r)
      for (int c = std::max(0, col); c < std::min(width, col + size); ++c) most = std::max(most, at(c, r));
    return most;
  }
  [[nodiscard]] int at(int col, int row) const {
    if (col < 0 || row < 0 || col >= width || row >= height) return 0;
    return values.data()[row * width + col];
  }
};

Field random_field(std::uint64_t seed) {
  testing::Dice dice(seed, 30);
  Field field{.width = dice.between(1, 50), .height = dice.between(1, 50), .values = {}};
  const double filled = dice.between(0.0, 0.2);
  for (int i = 0; i < field.width * field.height; ++i)
    field.values.push_back(dice.chance(filled) ? static_cast<std::uint8_t>(dice.between(1, 255))
                                               : std::uint8_t{0});
  return field;
}

int floor_divide(int a, int b) {
  return a >= 0 ? a / b : -((b - 1 - a) / b);
}

TEST(BoundTable, WindowSizesGrowAndAreFound) {
  for (int halves = 1; halves <= BoundTable::window_halves(BoundTable::window_sizes - 1); ++halves) {
    const int index = BoundTable::window_index(halves);
    ASSERT_GE(index, 0);
    EXPECT_GE(BoundTable::window_halves(index), halves);
    if (index > 0) {
      EXPECT_LT(BoundTable::window_halves(index - 1), halves);
    }
  }
  EXPECT_EQ(BoundTable::window_index(BoundTable::window_halves(BoundTable::window_sizes - 1) + 1), -1);
}

// Every window of every size, from off the map on one side to off it on the other; the widest is wider
// than most of these maps.
TEST(BoundTable, HoldsTheQuantisedMaximumOfEveryWindow) {
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Field field = random_field(seed);
    const BoundTable table = internal::make_bound_table(field.values, field.width, field.height, block_cells);
    const int half = table.block_cells() / BoundTable::phases;
    for (int index = 0; index < BoundTable::window_sizes; ++index) {
      const int size = half * BoundTable::window_halves(index);
      for (int row_half = -size / half - 2; row_half <= field.height / half + 2; ++row_half) {
        for (int col_half = -size / half - 2; col_half <= field.width / half + 2; ++col_half) {
          const std::int32_t first = table.plane(index, row_half & 1, col_half & 1);
          const int row = floor_divide(row_half, 2) + BoundTable::pad_rows;
          const int col = floor_divide(col_half, 2) + BoundTable::pad_cols;
          const std::uint32_t column = table.planes().column_of_4[first + row * table.planes().stride + col];
          for (int up = 0; up < 4; ++up) {
            const int level = static_cast<int>((column >> (8 * up)) & 0xFFU);
            // A plane's rows are whole blocks apart.
            const int most = field.window_max(col_half * half, (row_half + 2 * up) * half, size);
            ASSERT_GE(level * 255, most * kernels::bound_levels);
            ASSERT_EQ(level, (most * kernels::bound_levels + 254) / 255)
                << "window " << index << " at halves " << col_half << ", " << row_half << ", up " << up;
          }
        }
      }
    }
  }
}

TEST(BoundTable, OutermostRunsAreEmpty) {
  const Field full{.width = 45, .height = 37, .values = std::vector<std::uint8_t>(45 * 37, 255)};
  const BoundTable table = internal::make_bound_table(full.values, full.width, full.height, block_cells);
  const kernels::BoundPlanes planes = table.planes();
  const auto largest = [&](int index, int col, int row) {
    std::uint32_t most = 0;
    for (int phase = 0; phase < 4; ++phase)
      for (int c = col; c < col + kernels::run_cols; ++c)
        for (int up = 0; up < 4; ++up)
          most = std::max(
              most, (planes.column_of_4[table.plane(index, phase / 2, phase % 2) + row * planes.stride + c] >>
                     (8 * up)) &
                        0xFFU);
    return static_cast<int>(most);
  };
  for (int index = 0; index < BoundTable::window_sizes; ++index) {
    for (int row = 0; row <= planes.last_row; ++row) {
      EXPECT_EQ(largest(index, 0, row), 0);
      EXPECT_EQ(largest(index, planes.last_col, row), 0);
    }
    for (int col = 0; col <= planes.last_col; ++col) {
      EXPECT_EQ(largest(index, col, 0), 0);
      EXPECT_EQ(largest(index, col, planes.last_row), 0);
    }
    EXPECT_EQ(largest(index, BoundTable::pad_cols, BoundTable::pad_rows), kernels::bound_levels);
  }
}

TEST(WindowTables, HoldTheMaximumOfEveryWindowThatATileMayTouch) {
  using kernels::WindowMaxima;
  for (std::uint64_t seed = 200; seed < 220; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Field field = random_field(seed);
    const WindowTables tables = internal::make_window_tables(field.values, field.width, field.height);
    const WindowMaxima maxima = tables.maxima();
    const int last_col = field.width + (kernels::tile_cols - 1) * block_cells;
    const int last_row = field.height + (kernels::tile_rows - 1) * block_cells;
    for (int row = -WindowMaxima::pad_rows; row <= last_row; ++row)
      for (int col = -WindowMaxima::pad_cols; col <= last_col; ++col) {
        const std::int32_t at = maxima.index(col + WindowMaxima::pad_cols, row + WindowMaxima::pad_rows);
        ASSERT_LT(static_cast<std::size_t>(at), tables.level.size());
        const auto most = static_cast<std::uint8_t>(field.window_max(col, row, block_cells));
        ASSERT_EQ(maxima.level[at], kernels::window_level(most)) << col << ", " << row;
      }
  }
}

TEST(WindowTables, HoldColumnsAroundTheWholeMap) {
  for (std::uint64_t seed = 100; seed < 140; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Field field = random_field(seed);
    const WindowTables tables = internal::make_window_tables(field.values, field.width, field.height);
    const kernels::WindowPlanes planes = tables.planes();
    for (int row = -block_cells; row < field.height + block_cells; ++row) {
      for (int col = -block_cells; col < field.width + block_cells; ++col) {
        const int at = (row + block_cells) * planes.stride + col + block_cells;
        for (int up = 0; up < 2; ++up)
          ASSERT_EQ((planes.column_of_2[at] >> (8 * up)) & 255, field.at(col, row + up))
              << col << ", " << row;
      }
    }
  }
}

}  // namespace
}  // namespace landfall
