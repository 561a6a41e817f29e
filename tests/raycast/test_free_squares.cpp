#include "raycast/free_squares.hpp"

#include <gtest/gtest.h>

#include <random>

#include "drawn_map.hpp"
#include "grid_oracle.hpp"

namespace landfall {
namespace {

int side_at(const raycast::FreeSquareTable& table, int direction, int col, int row) {
  const kernels::FreeSquares squares = table.view();
  const int index = direction * squares.width_cells * squares.height_cells + table.index(col, row);
  return static_cast<int>(squares.sides[index / 4] >> (8 * (index % 4)) & 255u);
}

// By trying sizes.
int largest_square(const GridMap& map, int direction, int col, int row) {
  const int step_col = direction % 2 == 0 ? 1 : -1;
  const int step_row = direction / 2 == 0 ? 1 : -1;
  const auto blocked = [&](int across, int up) {
    const CellIndex cell{.col = col + step_col * across, .row = row + step_row * up};
    const bool within =
        cell.col >= 0 && cell.col < map.width_cells && cell.row >= 0 && cell.row < map.height_cells;
    return !within || map.at(cell) == Occupancy::occupied;
  };
  for (int side = 0; side < kernels::FreeSquares::largest; ++side)
    for (int i = 0; i <= side; ++i)
      if (blocked(i, side) || blocked(side, i)) return side;
  return kernels::FreeSquares::largest;
}

TEST(FreeSquares, AreTheLargestOfEachDirection) {
  std::mt19937 rng(3);
  for (const double occupied_share : {0.0, 0.01, 0.2, 1.0}) {
    std::bernoulli_distribution occupied(occupied_share);
    std::vector<std::string> lines(23, std::string(38, '.'));
    for (std::string& line : lines)
      for (char& cell : line) cell = occupied(rng) ? '#' : '.';
    const GridMap map = testing::drawn_map(lines);
    const raycast::FreeSquareTable table(testing::grid_view(map));
    for (int direction = 0; direction < 4; ++direction)
      for (int row = 0; row < map.height_cells; ++row)
        for (int col = 0; col < map.width_cells; ++col)
          ASSERT_EQ(side_at(table, direction, col, row), largest_square(map, direction, col, row))
              << "direction " << direction << " column " << col << " row " << row;
  }
}

TEST(FreeSquares, HaveARingThatEndsRays) {
  const raycast::FreeSquareTable table(testing::grid_view(testing::drawn_map({"..", ".."})));
  for (int direction = 0; direction < 4; ++direction)
    for (int i = -1; i <= 2; ++i)
      for (const int border : {-1, 2}) {
        EXPECT_EQ(side_at(table, direction, border, i), kernels::FreeSquares::beyond_grid);
        EXPECT_EQ(side_at(table, direction, i, border), kernels::FreeSquares::beyond_grid);
      }
}

TEST(FreeSquares, StopAtTheLargestThatAByteHolds) {
  const std::vector<std::string> open(300, std::string(300, '.'));
  const GridMap map = testing::drawn_map(open);
  const raycast::FreeSquareTable table(testing::grid_view(map));
  EXPECT_EQ(side_at(table, 0, 0, 0), 254);
  EXPECT_EQ(side_at(table, 0, 46, 0), 254);
  EXPECT_EQ(side_at(table, 0, 47, 0), 253);
  EXPECT_EQ(side_at(table, 3, 299, 299), 254);
}

}  // namespace
}  // namespace landfall
