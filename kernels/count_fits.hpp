// How many of a scan's end points fall into marked cells: the fit of a pose.
#pragma once

#include <cstddef>
#include <cstdint>

namespace landfall::kernels {

// One bit a cell, row by row: cell (col, row) is bit col % 32 of words[row * row_words + col / 32]. The cells
// of the border must not be marked: what lies beyond the grid counts as lying there.
struct CellBits {
  const std::uint32_t* words = nullptr;
  std::int32_t row_words = 0;
  std::int32_t width_cells = 0;   // at least 1, less than 2^23
  std::int32_t height_cells = 0;  // row_words * height_cells less than 2^31
};

// In cells from the grid's corner.
struct PointPose {
  float x_cells = 0.0f;
  float y_cells = 0.0f;
  float cos_theta = 1.0f;
  float sin_theta = 0.0f;
};

// Points in the robot's frame, in cells. No fused multiply-add: equal over instruction sets.
std::int32_t count_fits(const CellBits& cells, const PointPose& pose, const float* x_cells,
                        const float* y_cells, std::size_t points);

namespace scalar {
std::int32_t count_fits(const CellBits& cells, const PointPose& pose, const float* x_cells,
                        const float* y_cells, std::size_t points);
}

}  // namespace landfall::kernels
