#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/score_block.cpp"
#include <hwy/foreach_target.h>
// foreach_target comes before highway.h
#include <hwy/highway.h>

#include <algorithm>

#include "kernels/isa.hpp"
#include "kernels/score_block.hpp"

HWY_BEFORE_NAMESPACE();
namespace landfall::kernels {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

void WindowIndices(const WindowPlanes& planes, int col, int row, const std::int32_t* point_col,
                   const std::int32_t* point_row, std::size_t points, std::int32_t* index) {
  const hn::ScalableTag<std::int32_t> d;
  const std::size_t lanes = hn::Lanes(d);
  const auto zero = hn::Zero(d);
  const auto first_col = hn::Set(d, col + block_cells);
  const auto first_row = hn::Set(d, row + block_cells);
  const auto last_col = hn::Set(d, planes.width + block_cells);
  const auto last_row = hn::Set(d, planes.height + block_cells);
  const auto stride = hn::Set(d, planes.stride);
  std::size_t i = 0;
  for (; i + lanes <= points; i += lanes) {
    const auto x = hn::Min(last_col, hn::Max(zero, hn::Add(first_col, hn::LoadU(d, point_col + i))));
    const auto y = hn::Min(last_row, hn::Max(zero, hn::Add(first_row, hn::LoadU(d, point_row + i))));
    hn::StoreU(hn::Add(hn::Mul(y, stride), x), d, index + i);
  }
  scalar::window_indices(planes, col, row, point_col + i, point_row + i, points - i, index + i);
}

// Two rows x eight columns stand in columns of two: lane 2 * col + row.
constexpr std::size_t pair_poses = 2 * block_cells;

HWY_INLINE const std::uint8_t* PairOfRows(const WindowPlanes& planes, std::int32_t index, std::size_t pair) {
  return reinterpret_cast<const std::uint8_t*>(planes.column_of_2 + index +
                                               2 * pair * static_cast<std::size_t>(planes.stride));
}

#if HWY_TARGET <= HWY_AVX2 && HWY_ARCH_X86
// All pairs stay in four registers.
HWY_INLINE void AddPoints(const WindowPlanes& planes, const std::int32_t* index, std::size_t count,
                          std::uint16_t* HWY_RESTRICT sums) {
  const hn::FixedTag<std::uint16_t, pair_poses> d;
  const hn::Rebind<std::uint8_t, decltype(d)> d_byte;
  const auto add = [&](auto sum, std::int32_t at, std::size_t pair) HWY_ATTR {
    return hn::Add(sum, hn::PromoteTo(d, hn::LoadU(d_byte, PairOfRows(planes, at, pair))));
  };
  auto sum0 = hn::Load(d, sums);
  auto sum1 = hn::Load(d, sums + pair_poses);
  auto sum2 = hn::Load(d, sums + 2 * pair_poses);
  auto sum3 = hn::Load(d, sums + 3 * pair_poses);
  for (std::size_t i = 0; i < count; ++i) {
    sum0 = add(sum0, index[i], 0);
    sum1 = add(sum1, index[i], 1);
    sum2 = add(sum2, index[i], 2);
    sum3 = add(sum3, index[i], 3);
  }
  hn::Store(sum0, d, sums);
  hn::Store(sum1, d, sums + pair_poses);
  hn::Store(sum2, d, sums + 2 * pair_poses);
  hn::Store(sum3, d, sums + 3 * pair_poses);
}
#else
HWY_INLINE void AddPoints(const WindowPlanes& planes, const std::int32_t* index, std::size_t count,
                          std::uint16_t* HWY_RESTRICT sums) {
  const hn::CappedTag<std::uint16_t, pair_poses> d;
  const hn::Rebind<std::uint8_t, decltype(d)> d_byte;
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t pair = 0; pair < block_cells / 2; ++pair)
      for (std::size_t lane = 0; lane < pair_poses; lane += hn::Lanes(d)) {
        std::uint16_t* sum = sums + pair * pair_poses + lane;
        const auto value = hn::PromoteTo(d, hn::LoadU(d_byte, PairOfRows(planes, index[i], pair) + lane));
        hn::Store(hn::Add(hn::Load(d, sum), value), d, sum);
      }
}
#endif

std::int32_t LargestOf(const std::uint16_t* sums) {
  const hn::CappedTag<std::uint16_t, 32> d;
  auto largest = hn::Load(d, sums);
  for (std::size_t lane = hn::Lanes(d); lane < block_poses; lane += hn::Lanes(d)) {
    largest = hn::Max(largest, hn::Load(d, sums + lane));
  }
  return hn::GetLane(hn::MaxOfLanes(d, largest));
}

bool ScoreBlock(const WindowPlanes& planes, const std::int32_t* index, std::size_t points,
                std::int32_t threshold, std::int32_t* scores) {
  constexpr std::size_t points_per_look = 32;
  constexpr std::size_t points_per_flush = 256;  // 16 bits hold 257
  HWY_ALIGN std::uint16_t sums[block_poses] = {};
  HWY_ALIGN std::int32_t totals[block_poses] = {};
  std::int32_t largest_total = 0;
  for (std::size_t i = 0; i < points;) {
    const std::size_t count = std::min(points_per_look, points - i);
    AddPoints(planes, index + i, count, sums);
    i += count;
    const std::int64_t rest = 255 * static_cast<std::int64_t>(points - i);
    if (largest_total + LargestOf(sums) + rest < threshold) return false;
    if (i % points_per_flush == 0 || i == points) {
      for (int lane = 0; lane < block_poses; ++lane) {
        totals[lane] += sums[lane];
        sums[lane] = 0;
        largest_total = std::max(largest_total, totals[lane]);
      }
    }
  }
  if (largest_total < threshold) return false;
  for (int row = 0; row < block_cells; ++row)
    for (int col = 0; col < block_cells; ++col)
      scores[row * block_cells + col] = totals[row / 2 * static_cast<int>(pair_poses) + 2 * col + row % 2];
  return true;
}

}  // namespace HWY_NAMESPACE
}  // namespace landfall::kernels
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace landfall::kernels {

namespace scalar {

void window_indices(const WindowPlanes& planes, int col, int row, const std::int32_t* point_col,
                    const std::int32_t* point_row, std::size_t points, std::int32_t* index) {
  for (std::size_t i = 0; i < points; ++i) {
    const int x = std::clamp(col + block_cells + point_col[i], 0, planes.width + block_cells);
    const int y = std::clamp(row + block_cells + point_row[i], 0, planes.height + block_cells);
    index[i] = y * planes.stride + x;
  }
}

std::int32_t bound_block(const WindowPlanes& planes, const std::int32_t* index, std::size_t points,
                         std::int32_t /*threshold*/) {
  std::int32_t sum = 0;
  for (std::size_t i = 0; i < points; ++i) sum += planes.window_max[index[i]];
  return sum;
}

bool score_block(const WindowPlanes& planes, const std::int32_t* index, std::size_t points,
                 std::int32_t threshold, std::int32_t* scores) {
  std::int32_t largest = 0;
  for (int row = 0; row < block_cells; ++row) {
    for (int col = 0; col < block_cells; ++col) {
      std::int32_t sum = 0;
      for (std::size_t i = 0; i < points; ++i) {
        sum += static_cast<std::int32_t>(planes.column_of_2[index[i] + row * planes.stride + col] & 255U);
      }
      scores[row * block_cells + col] = sum;
      largest = std::max(largest, sum);
    }
  }
  return largest >= threshold;
}

}  // namespace scalar

HWY_EXPORT(WindowIndices);
HWY_EXPORT(ScoreBlock);

void window_indices(const WindowPlanes& planes, int col, int row, const std::int32_t* point_col,
                    const std::int32_t* point_row, std::size_t points, std::int32_t* index) {
  if (scalar_selected()) {
    scalar::window_indices(planes, col, row, point_col, point_row, points, index);
  } else {
    HWY_DYNAMIC_DISPATCH(WindowIndices)(planes, col, row, point_col, point_row, points, index);
  }
}

// Plain loads: on the machines measured, gathers of as many bytes took half as long again.
std::int32_t bound_block(const WindowPlanes& planes, const std::int32_t* index, std::size_t points,
                         std::int32_t threshold) {
  constexpr std::size_t points_per_look = 48;
  const std::uint8_t* window_max = planes.window_max;
  std::int32_t sum = 0;
  for (std::size_t i = 0; i < points;) {
    const std::size_t end = std::min(points, i + points_per_look);
    std::int32_t other = 0;  // two chains of additions run side by side
    for (; i + 2 <= end; i += 2) {
      sum += window_max[index[i]];
      other += window_max[index[i + 1]];
    }
    if (i < end) sum += window_max[index[i++]];
    sum += other;
    const std::int64_t rest = 255 * static_cast<std::int64_t>(points - i);
    if (sum + rest < threshold) return sum + static_cast<std::int32_t>(rest);
  }
  return sum;
}

bool score_block(const WindowPlanes& planes, const std::int32_t* index, std::size_t points,
                 std::int32_t threshold, std::int32_t* scores) {
  return scalar_selected() ? scalar::score_block(planes, index, points, threshold, scores)
                           : HWY_DYNAMIC_DISPATCH(ScoreBlock)(planes, index, points, threshold, scores);
}

}  // namespace landfall::kernels
#endif
