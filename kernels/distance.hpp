// Squared distances to the nearest occupied cell, in cells, between cell centres.
#pragma once

#include <cstddef>
#include <cstdint>

namespace landfall::kernels {

inline constexpr std::int32_t far_squared = std::int32_t{1} << 30;

// Vertical pass, shared by both transforms below: cells up or down to the nearest occupied cell of
// the same column, at most `cap` (which also says "none"). Columns [first_col, last_col).
void column_distances(const std::uint8_t* occupied, int width, int height, int cap, int first_col,
                      int last_col, std::uint16_t* distance);

// One row of squared distances, exact below (radius + 1)^2 and clamped to that, from column distances
// with cap > radius. Windowed minimum: cost grows with radius, but it is plain vector work.
void clamped_row(const std::uint16_t* column_distance, int width, int radius, std::int32_t* squared);

// One row, exact everywhere: lower envelope of parabolas (Felzenszwalb & Huttenlocher 2012,
// algorithm 1), from column distances with cap above the map's height. Columns without occupied cell
// have the cap. Scratch: 2 (width + 1) elements.
void exact_row(const std::uint16_t* column_distance, int width, int cap, std::int32_t* scratch,
               std::int32_t* squared);

}  // namespace landfall::kernels
