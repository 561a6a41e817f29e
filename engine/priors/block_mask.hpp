// Sets of cells as one 64-bit word per block of 8 x 8 cells: bit row * 8 + col within the block.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "kernels/score_block.hpp"

namespace landfall::internal {

// Cells [col0, col1] x [row0, row1]; none by default.
struct CellRange {
  int col0 = 0;
  int row0 = 0;
  int col1 = -1;
  int row1 = -1;
  [[nodiscard]] bool empty() const { return col0 > col1 || row0 > row1; }
};

// The least multiple of `step` that is not below a value >= 0.
inline int next_multiple(int value, int step) {
  return (value + step - 1) / step * step;
}

struct BlockMask {
  int first_col = 0;  // of the stored rectangle, in blocks
  int first_row = 0;
  int cols = 0;
  int rows = 0;
  std::vector<std::uint64_t> words;  // row by row
  std::int64_t counted = -1;         // see remember_count()

  // The cells of block (col, row); none outside the rectangle.
  [[nodiscard]] std::uint64_t at(int col, int row) const {
    const int c = col - first_col;
    const int r = row - first_row;
    if (c < 0 || r < 0 || c >= cols || r >= rows) return 0;
    return words[static_cast<std::size_t>(r) * static_cast<std::size_t>(cols) + static_cast<std::size_t>(c)];
  }
  void insert(int cell_col, int cell_row) {
    const auto c = static_cast<std::size_t>(cell_col / kernels::block_cells - first_col);
    const auto r = static_cast<std::size_t>(cell_row / kernels::block_cells - first_row);
    words[r * static_cast<std::size_t>(cols) + c] |= std::uint64_t{1} << bit_of(cell_col, cell_row);
  }
  // Cells of block (col, row), which the rectangle has to hold.
  void insert_block(int col, int row, std::uint64_t cells) {
    words[static_cast<std::size_t>(row - first_row) * static_cast<std::size_t>(cols) +
          static_cast<std::size_t>(col - first_col)] |= cells;
  }
  [[nodiscard]] bool contains(int cell_col, int cell_row) const {
    if (cell_col < 0 || cell_row < 0) return false;
    return (at(cell_col / kernels::block_cells, cell_row / kernels::block_cells) >>
            bit_of(cell_col, cell_row)) &
           1U;
  }
  [[nodiscard]] std::int64_t count() const { return counted >= 0 ? counted : count_cells(); }
  // For masks that many will ask: nothing may be inserted afterwards.
  void remember_count() { counted = count_cells(); }

 private:
  [[nodiscard]] std::int64_t count_cells() const;
  static int bit_of(int cell_col, int cell_row) {
    return (cell_row % kernels::block_cells) * kernels::block_cells + cell_col % kernels::block_cells;
  }
};

using SharedMask = std::shared_ptr<const BlockMask>;

// An empty mask over the cells [col0, col1] x [row0, row1] of the grid.
BlockMask make_block_mask(int col0, int row0, int col1, int row1);

// Cells in either.
BlockMask merged(const BlockMask& a, const BlockMask& b);

}  // namespace landfall::internal
