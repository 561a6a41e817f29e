// Exhaustive scoring: one heading, one row of poses, all columns.
#pragma once

#include <cstddef>
#include <cstdint>

namespace landfall::kernels {

// Adds to scores[c], c in [0, width), the field at each point's cell (row + point_row[i], c +
// point_col[i]), 0 where that lies outside the width x height field. `partial` is scratch of width
// elements.
void score_row(const std::uint8_t* field, int width, int height, int row, const std::int32_t* point_col,
               const std::int32_t* point_row, std::size_t points, std::uint16_t* partial,
               std::int32_t* scores);

namespace scalar {
void score_row(const std::uint8_t* field, int width, int height, int row, const std::int32_t* point_col,
               const std::int32_t* point_row, std::size_t points, std::uint16_t* partial,
               std::int32_t* scores);
}

}  // namespace landfall::kernels
