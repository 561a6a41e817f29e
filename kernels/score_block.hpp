// Leaves of the search: blocks of 8 x 8 poses at one heading.
#pragma once

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
};

// index[i]: the element where the window of point i begins, for the block whose
// lower-left cell is (row, col); windows off the map get an element whose window is empty.
void window_indices(const WindowPlanes& planes, int col, int row, const std::int32_t* point_col,
                    const std::int32_t* point_row, std::size_t points, std::int32_t* index);

// The block's 64 scores, exactly. scores[row * 8 + col]. False, scores undefined, once none can
// reach `threshold`; it looks after every 32 points.
bool score_block(const WindowPlanes& planes, const std::int32_t* index, std::size_t points,
                 std::int32_t threshold, std::int32_t* scores);

namespace scalar {
void window_indices(const WindowPlanes& planes, int col, int row, const std::int32_t* point_col,
                    const std::int32_t* point_row, std::size_t points, std::int32_t* index);
bool score_block(const WindowPlanes& planes, const std::int32_t* index, std::size_t points,
                 std::int32_t threshold, std::int32_t* scores);
}  // namespace scalar

}  // namespace landfall::kernels
