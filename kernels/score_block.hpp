// Leaves of the search: blocks of 8 x 8 poses at one heading.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace landfall::kernels {

inline constexpr int block_cells = 8;
inline constexpr int block_poses = block_cells * block_cells;

// A padded plane around a width x height field, `block_cells` more cells on every side, so that every
// 8 x 8 window that touches the map can be read whole; beyond them all is 0.
struct WindowPlanes {
  const std::uint16_t* column_of_2 = nullptr;  // [row][col]: two rows' values from there upwards, the lower
                                               // row in the lower byte
  std::int32_t stride = 0;                     // elements a row
  std::int32_t width = 0;                      // of the field
  std::int32_t height = 0;

  // Of the window that begins at a cell of the field, wherever; one off the map is empty.
  [[nodiscard]] std::int32_t index(std::int32_t col, std::int32_t row) const {
    return std::clamp(row + block_cells, 0, height + block_cells) * stride +
           std::clamp(col + block_cells, 0, width + block_cells);
  }
};

// The 64 scores of the block whose lower-left cell is (row, col), exactly. scores[row * 8 + col]. False,
// scores undefined, once none can reach `threshold`; it looks after every 32 points.
bool score_block(const WindowPlanes& planes, int col, int row, const std::int32_t* point_col,
                 const std::int32_t* point_row, std::size_t points, std::int32_t threshold,
                 std::int32_t* scores);

namespace scalar {
bool score_block(const WindowPlanes& planes, int col, int row, const std::int32_t* point_col,
                 const std::int32_t* point_row, std::size_t points, std::int32_t threshold,
                 std::int32_t* scores);
}

}  // namespace landfall::kernels
