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

// Sums of four rows x eight columns in columns of four: lane 4 * col + row.
template <class D16>
HWY_INLINE void AddHalf(D16 d, const std::uint8_t* HWY_RESTRICT window, std::uint16_t* HWY_RESTRICT sums) {
  const hn::Rebind<std::uint8_t, D16> d_byte;
  for (std::size_t lane = 0; lane < block_poses / 2; lane += hn::Lanes(d)) {
    const auto value = hn::PromoteTo(d, hn::LoadU(d_byte, window + lane));
    hn::Store(hn::Add(hn::Load(d, sums + lane), value), d, sums + lane);
  }
}

#if HWY_TARGET <= HWY_AVX3 && HWY_ARCH_X86
// Both halves stay in two registers.
HWY_INLINE void AddPoints(const WindowPlanes& planes, const std::int32_t* index, std::size_t count,
                          std::uint16_t* HWY_RESTRICT sums) {
  const hn::FixedTag<std::uint16_t, 32> d;
  const hn::Rebind<std::uint8_t, decltype(d)> d_byte;
  const std::size_t up = 4 * static_cast<std::size_t>(planes.stride);
  auto lower = hn::Load(d, sums);
  auto upper = hn::Load(d, sums + 32);
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint32_t* window = planes.column_of_4 + index[i];
    lower =
        hn::Add(lower, hn::PromoteTo(d, hn::LoadU(d_byte, reinterpret_cast<const std::uint8_t*>(window))));
    upper = hn::Add(upper,
                    hn::PromoteTo(d, hn::LoadU(d_byte, reinterpret_cast<const std::uint8_t*>(window + up))));
  }
  hn::Store(lower, d, sums);
  hn::Store(upper, d, sums + 32);
}
#else
HWY_INLINE void AddPoints(const WindowPlanes& planes, const std::int32_t* index, std::size_t count,
                          std::uint16_t* HWY_RESTRICT sums) {
  const hn::CappedTag<std::uint16_t, 32> d;
  const std::size_t up = 4 * static_cast<std::size_t>(planes.stride);
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint32_t* window = planes.column_of_4 + index[i];
    AddHalf(d, reinterpret_cast<const std::uint8_t*>(window), sums);
    AddHalf(d, reinterpret_cast<const std::uint8_t*>(window + up), sums + block_poses / 2);
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
  for (int col = 0; col < block_cells; ++col) {
    for (int row = 0; row < 4; ++row) {
      scores[row * block_cells + col] = totals[4 * col + row];
      scores[(row + 4) * block_cells + col] = totals[block_poses / 2 + 4 * col + row];
    }
  }
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
        sum += static_cast<std::int32_t>(planes.column_of_4[index[i] + row * planes.stride + col] & 255U);
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
