#include "raycast/free_squares.hpp"

#include <algorithm>
#include <bit>
#include <cassert>

namespace landfall::raycast {
namespace {

using kernels::FreeSquares;

static_assert(std::endian::native == std::endian::little);

// Goes along a row, from the end that squares reach towards: a cell's square is one more than the least of
// its three neighbours there.
class RowScan {
 public:
  // ahead: the row that squares reach into.
  RowScan(const std::uint8_t* ahead, std::uint8_t* row) : ahead_(ahead), row_(row) {}

  void take(int col, bool obstacle) {
    const int beside = ahead_[col];
    const int least = std::min({side_, beside, corner_, FreeSquares::largest - 1});
    side_ = obstacle ? FreeSquares::obstacle : least + 1;
    corner_ = beside;
    row_[col] = static_cast<std::uint8_t>(side_);
  }

 private:
  const std::uint8_t* ahead_;
  std::uint8_t* row_;
  int side_ = 0;
  int corner_ = 0;
};

// The grids of squares to the right and to the left, both up or both down.
void fill_row(const Grid& grid, int row, RowScan to_right, RowScan to_left) {
  const auto width = static_cast<std::size_t>(grid.width_cells);
  const std::span<const std::uint8_t> cells =
      grid.cells.subspan(static_cast<std::size_t>(row) * width, width);
  for (int left = 0, right = grid.width_cells - 1; right >= 0; ++left, --right) {
    to_right.take(right, cells[static_cast<std::size_t>(right)] == grid.occupied);
    to_left.take(left, cells[static_cast<std::size_t>(left)] == grid.occupied);
  }
}

std::size_t word_count(std::int32_t width_cells, std::int32_t height_cells) {
  return static_cast<std::size_t>(width_cells) * static_cast<std::size_t>(height_cells);  // 4 grids of bytes
}

}  // namespace

bool FreeSquareTable::can_hold(int width_cells, int height_cells) {
  const auto cells = (std::int64_t{2} + width_cells) * (std::int64_t{2} + height_cells);
  return cells < std::int64_t{1} << 29;
}

FreeSquareTable::FreeSquareTable(const Grid& grid)
    : width_cells_(grid.width_cells + 2),
      height_cells_(grid.height_cells + 2),
      words_(word_count(width_cells_, height_cells_), ~std::uint32_t{0}) {
  static_assert(FreeSquares::beyond_grid == 255);
  const std::size_t cells = words_.size();
  assert(can_hold(grid.width_cells, grid.height_cells));
  auto* sides = reinterpret_cast<std::uint8_t*>(words_.data());
  const std::vector<std::uint8_t> nothing(static_cast<std::size_t>(width_cells_), FreeSquares::obstacle);
  const auto fill = [&](int row, int row_ahead, std::uint8_t* first_grid) {
    const bool within = row_ahead >= 0 && row_ahead < grid.height_cells;
    const auto scan = [&](std::uint8_t* squares) {
      return RowScan(within ? squares + index(0, row_ahead) : nothing.data(), squares + index(0, row));
    };
    fill_row(grid, row, scan(first_grid), scan(first_grid + cells));
  };
  for (int row = grid.height_cells - 1; row >= 0; --row) fill(row, row + 1, sides);
  for (int row = 0; row < grid.height_cells; ++row) fill(row, row - 1, sides + 2 * cells);
}

}  // namespace landfall::raycast
