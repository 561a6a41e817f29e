// The state of rays between two steps of march_rays.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>

namespace landfall::kernels {

inline constexpr float no_echo = std::numeric_limits<float>::infinity();
inline constexpr float most_per_cell = 1e30f;  // in place of infinity: 0 cells of it are 0

// Packets take a step each in turn, so that their loads overlap: 1.3 to 1.7 times the rays of one packet
// after the other, measured once, by a timer that is not kept.
inline constexpr std::size_t rays_under_way = 256;

// Mirrored so that columns and rows go up. Lengths in cells.
struct alignas(64) RaysUnderWay {
  float x[rays_under_way], y[rays_under_way];  // within the start cell
  float dx[rays_under_way], dy[rays_under_way];
  float per_col[rays_under_way], per_row[rays_under_way];  // length from one column, row to the next
  float range_max[rays_under_way];
  std::int32_t start[rays_under_way];  // index among the sides
  std::int32_t col_step[rays_under_way], row_step[rays_under_way];
  std::int32_t col[rays_under_way], row[rays_under_way];  // from the start cell
  float length[rays_under_way];
};

}  // namespace landfall::kernels
