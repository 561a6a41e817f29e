// Bounds of a tile of neighbouring blocks at one heading: the maximum of the very window that each point can
// fall into.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>

#include "kernels/bound_tile.hpp"
#include "kernels/score_block.hpp"

namespace landfall::kernels {

// Values of the window maxima: 0 .. 127, rounded up, so that two of them still fit into a byte.
inline constexpr int window_levels = 127;
constexpr std::uint8_t window_level(std::uint8_t field_value) {
  return static_cast<std::uint8_t>((field_value + 1) / 2 - field_value / 255);
}
// A pose of a score has windows whose levels sum up to at least this.
constexpr std::int32_t window_units(std::int32_t score) {
  return static_cast<std::int32_t>((std::int64_t{score} * window_levels + 254) / 255);
}

// Maxima of all windows of 8 x 8 cells in such levels, by phase: [row % 8][col % 8][row / 8][col / 8] of a
// map padded by a tile on every side, so that the windows of neighbouring blocks are neighbours.
struct WindowMaxima {
  const std::uint8_t* level = nullptr;
  std::int32_t stride = 0;      // elements a row of one phase
  std::int32_t phase_size = 0;  // elements of one phase
  std::int32_t width = 0;       // of the field, cells
  std::int32_t height = 0;

  static constexpr std::int32_t pad_cols = tile_cols * block_cells;
  static constexpr std::int32_t pad_rows = tile_rows * block_cells;

  // The element of the window that begins at a cell of the padded map, counted from its corner; were the
  // map endless, for cells off it.
  [[nodiscard]] std::int32_t index(std::int32_t padded_col, std::int32_t padded_row) const {
    constexpr std::int32_t mask = block_cells - 1;
    constexpr int shift = std::countr_zero(static_cast<unsigned>(block_cells));
    const std::int32_t phase = (padded_row & mask) * block_cells + (padded_col & mask);
    const std::int64_t block = std::int64_t{padded_row >> shift} * stride + (padded_col >> shift);
    return static_cast<std::int32_t>(std::int64_t{phase} * phase_size + block);
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

// A scan's points at one heading.
struct TilePoints {
  const std::int32_t* col = nullptr;  // of their cells, from the robot's
  const std::int32_t* row = nullptr;
  const std::int32_t* window = nullptr;  // tile_index() of each, were the map endless
  std::size_t count = 0;
  std::int32_t least_col = 0, most_col = 0;  // of all points; 0 is among them
  std::int32_t least_row = 0, most_row = 0;
};
// Of `count` of them; `window` is filled.
TilePoints tile_points(const WindowMaxima& maxima, const std::int32_t* col, const std::int32_t* row,
                       std::size_t count, std::int32_t* window);

// bounds[row * tile_cols + col]: the sum over all points of the windows' levels, for the block that begins at
// cell (first_col + 8 * col, first_row + 8 * row), where first_col and first_row are multiples of 8. `blocks`
// has a bit, row * tile_cols + col, for each that is asked for. Returns the bits of those whose bound reaches
// `threshold`; of the others bounds are undefined. It looks after every 64 points whether any still can.
std::uint64_t bound_windows(const WindowMaxima& maxima, int first_col, int first_row,
                            const TilePoints& points, std::int32_t threshold, std::uint64_t blocks,
                            std::int32_t* bounds);

namespace scalar {
TilePoints tile_points(const WindowMaxima& maxima, const std::int32_t* col, const std::int32_t* row,
                       std::size_t count, std::int32_t* window);
std::uint64_t bound_windows(const WindowMaxima& maxima, int first_col, int first_row,
                            const TilePoints& points, std::int32_t threshold, std::uint64_t blocks,
                            std::int32_t* bounds);
}  // namespace scalar

}  // namespace landfall::kernels
