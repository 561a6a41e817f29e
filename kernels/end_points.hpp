// End points of a scan at one heading, as cell offsets from the robot's cell.
#pragma once

#include <cstddef>
#include <cstdint>

namespace landfall::kernels {

// For each end point (x, y), in cells in the robot's frame: the offset of its cell from the robot's
// cell, when the robot stands in the centre of a cell with heading (cos, sin):
// col = floor(0.5 + (cos x - sin y)), row = floor(0.5 + (sin x + cos y)). No fused multiply-add, so
// that every instruction set rounds alike. |x|, |y| below 2^29.
void end_point_cells(const double* x_cells, const double* y_cells, std::size_t points, double cos_heading,
                     double sin_heading, std::int32_t* col, std::int32_t* row);

namespace scalar {
void end_point_cells(const double* x_cells, const double* y_cells, std::size_t points, double cos_heading,
                     double sin_heading, std::int32_t* col, std::int32_t* row);
}

}  // namespace landfall::kernels
