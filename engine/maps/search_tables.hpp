// What branch and bound reads: window maxima of the likelihood field, from single blocks of 8 x 8 cells
// (window planes) to coarse tables for groups of headings (bound tables).
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "kernels/bound_tile.hpp"
#include "kernels/merge_windows.hpp"
#include "kernels/score_block.hpp"
#include "kernels/window_tile.hpp"

namespace landfall::internal {

// Window maxima of 0..31 for blocks of `block_cells` cells, one set of planes per window size: windows
// begin at every half block, stored by phase (even and odd halves apart), so that neighbouring blocks
// are neighbours, four rows to an element.
class BoundTable {
 public:
  static constexpr int window_sizes = 5;
  static constexpr int phases = 2;
  // In half blocks. The smallest holds a block and the rounding of its offset to a half block.
  static constexpr std::array<int, window_sizes> sizes{3, 4, 6, 10, 18};

  // From maxima over half-block cells: halves[row * half_cols + col].
  BoundTable(const std::vector<std::uint8_t>& halves, int half_cols, int half_rows, int block_cells);

  [[nodiscard]] int block_cells() const { return block_cells_; }
  // Window size of index i in half blocks, and the first index that covers `halves` of them; -1: none.
  static int window_halves(int index) { return sizes[static_cast<std::size_t>(index)]; }
  static int window_index(int halves) {
    return halves > sizes.back() ? -1 : index_of_halves[static_cast<std::size_t>(halves)];
  }
  [[nodiscard]] kernels::BoundPlanes planes() const;
  [[nodiscard]] const kernels::WindowShelf& shelf() const { return shelf_; }
  // First element of a plane.
  [[nodiscard]] std::int32_t plane(int window_index, int phase_row, int phase_col) const {
    return ((window_index * phases + phase_row) * phases + phase_col) * plane_size_;
  }
  // The padding to be added to a block index to get a plane's column or row.
  static constexpr int pad_cols = kernels::run_cols + 12;
  static constexpr int pad_rows = kernels::tile_rows + 12;
  [[nodiscard]] std::size_t memory_bytes() const { return 4 * column_of_4_.capacity(); }

 private:
  static constexpr std::array<int, sizes.back() + 1> index_of_halves = [] {
    std::array<int, sizes.back() + 1> index{};
    for (std::size_t halves = 0; halves < index.size(); ++halves)
      while (sizes[static_cast<std::size_t>(index[halves])] < static_cast<int>(halves)) ++index[halves];
    return index;
  }();

  void fill_planes(int index, const std::vector<std::uint8_t>& halves, int half_cols, int half_rows);

  int block_cells_;
  int cols_;  // of a plane, padding included
  int rows_;
  std::int32_t plane_size_;
  kernels::WindowShelf shelf_{};
  std::vector<std::uint32_t> column_of_4_;
};

// For blocks of 8 x 8 poses at one heading.
struct WindowTables {
  int width_cells = 0;
  int height_cells = 0;
  std::vector<std::uint8_t> level;         // as WindowMaxima says
  std::vector<std::uint16_t> column_of_2;  // as WindowPlanes says

  [[nodiscard]] kernels::WindowMaxima maxima() const;
  [[nodiscard]] kernels::WindowPlanes planes() const;
  [[nodiscard]] std::size_t memory_bytes() const { return level.capacity() + 2 * column_of_2.capacity(); }
};

WindowTables make_window_tables(std::span<const std::uint8_t> field, int width_cells, int height_cells);
BoundTable make_bound_table(std::span<const std::uint8_t> field, int width_cells, int height_cells,
                            int cells_a_block);

}  // namespace landfall::internal
