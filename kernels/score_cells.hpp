// Sums of products of two occupancy grids: one row of poses.
#pragma once

#include <cstddef>
#include <cstdint>

namespace landfall::kernels {

// Cells of a local grid, run after run of equal weight. Run r is cells [run_end[r - 1], run_end[r]), from 0.
struct CellRuns {
  const std::int32_t* offset = nullptr;  // in the global grid, from the robot's cell
  const std::int32_t* run_end = nullptr;
  const std::int32_t* run_weight = nullptr;
  std::size_t runs = 0;
};

// The global grid is read, and scores are written, up to a multiple of this many columns.
inline constexpr std::size_t score_columns = 64;
constexpr std::size_t whole_columns(std::size_t cols) {
  return (cols + score_columns - 1) / score_columns * score_columns;
}

// scores[c] = sum of weight x global[c + offset], for c in [0, cols). Values of the global grid are -1, 0 and
// 1; it must be readable over whole_columns(cols) from every offset. What is written beyond cols means
// nothing.
void score_cells(const std::int8_t* global, const CellRuns& local, std::size_t cols, std::int32_t* scores);

namespace scalar {
void score_cells(const std::int8_t* global, const CellRuns& local, std::size_t cols, std::int32_t* scores);
}

}  // namespace landfall::kernels
