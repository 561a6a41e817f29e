// Bounds of a tile of neighbouring blocks at one heading: the maximum of the very window that each point can
// fall into.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "kernels/bound_tile.hpp"
#include "kernels/score_block.hpp"

namespace landfall::kernels {

// Maxima of all windows of 8 x 8 cells, by phase: [row % 8][col % 8][row / 8][col / 8] of a map padded by a
// tile on every side, so that the windows of neighbouring blocks are neighbours.
struct WindowMaxima {
  const std::uint8_t* window_max = nullptr;
  std::int32_t stride = 0;      // elements a row of one phase
  std::int32_t phase_size = 0;  // elements of one phase
  std::int32_t width = 0;       // of the field, cells
  std::int32_t height = 0;

  static constexpr std::int32_t pad_cols = tile_cols * block_cells;
  static constexpr std::int32_t pad_rows = tile_rows * block_cells;

  // The element of the window that begins at a cell of the padded map, counted from its corner.
  [[nodiscard]] std::int32_t index(std::int32_t padded_col, std::int32_t padded_row) const {
    constexpr std::int32_t mask = block_cells - 1;
    const std::int32_t phase = (padded_row & mask) * block_cells + (padded_col & mask);
    return phase * phase_size + padded_row / block_cells * stride + padded_col / block_cells;
  }
  // Of the window that begins at a cell of the map, wherever; that of the block `col` to the right and `row`
  // upwards is col + row * stride elements on. A tile off the map gets elements that are empty.
  [[nodiscard]] std::int32_t tile_index(std::int32_t col, std::int32_t row) const {
    return index(std::clamp(col + pad_cols, 0, width + pad_cols),
                 std::clamp(row + pad_rows, 0, height + pad_rows));
  }
};

// Bit row * tile_cols + col of every block of a tile whose bit tile_lane(col, row) is set.
std::uint64_t row_by_row(std::uint64_t lanes);

// bounds[row * tile_cols + col]: the sum over all points of the windows' maxima, for the block that begins at
// cell (first_col + 8 * col, first_row + 8 * row). `blocks` has a bit, row * tile_cols + col, for each that
// is asked for. Returns the bits of those whose bound reaches `threshold`; of the others bounds are
// undefined. It looks after every 32 points whether any still can.
std::uint64_t bound_windows(const WindowMaxima& maxima, int first_col, int first_row,
                            const std::int32_t* point_col, const std::int32_t* point_row, std::size_t points,
                            std::int32_t threshold, std::uint64_t blocks, std::int32_t* bounds);

namespace scalar {
std::uint64_t bound_windows(const WindowMaxima& maxima, int first_col, int first_row,
                            const std::int32_t* point_col, const std::int32_t* point_row, std::size_t points,
                            std::int32_t threshold, std::uint64_t blocks, std::int32_t* bounds);
}

}  // namespace landfall::kernels
