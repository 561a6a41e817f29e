#include "engine/priors/block_mask.hpp"

#include <algorithm>
#include <bit>

namespace landfall::internal {

std::int64_t BlockMask::count_cells() const {
  std::int64_t cells = 0;
  for (const std::uint64_t word : words) cells += std::popcount(word);
  return cells;
}

BlockMask make_block_mask(int col0, int row0, int col1, int row1) {
  using kernels::block_cells;
  BlockMask mask{.first_col = col0 / block_cells,
                 .first_row = row0 / block_cells,
                 .cols = col1 / block_cells - col0 / block_cells + 1,
                 .rows = row1 / block_cells - row0 / block_cells + 1,
                 .words = {}};
  mask.words.resize(static_cast<std::size_t>(mask.cols) * static_cast<std::size_t>(mask.rows));
  return mask;
}

BlockMask merged(const BlockMask& a, const BlockMask& b) {
  if (a.words.empty()) return b;
  if (b.words.empty()) return a;
  BlockMask either{.first_col = std::min(a.first_col, b.first_col),
                   .first_row = std::min(a.first_row, b.first_row),
                   .cols = 0,
                   .rows = 0,
                   .words = {}};
  either.cols = std::max(a.first_col + a.cols, b.first_col + b.cols) - either.first_col;
  either.rows = std::max(a.first_row + a.rows, b.first_row + b.rows) - either.first_row;
  for (int row = either.first_row; row < either.first_row + either.rows; ++row)
    for (int col = either.first_col; col < either.first_col + either.cols; ++col)
      either.words.push_back(a.at(col, row) | b.at(col, row));
  return either;
}

}  // namespace landfall::internal
