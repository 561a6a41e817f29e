#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/score_block.cpp"
#include <hwy/foreach_target.h>
// foreach_target comes before highway.h
#include <hwy/highway.h>

#include <algorithm>

#include "kernels/isa.hpp"
#include "kernels/row_sums-inl.hpp"
#include "kernels/score_block.hpp"

HWY_BEFORE_NAMESPACE();
namespace landfall::kernels {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// index[i]: where the window of point i begins.
void WindowIndices(const WindowPlanes& planes, int col, int row, const std::int32_t* point_col,
                   const std::int32_t* point_row, std::size_t count, std::int32_t* HWY_RESTRICT index) {
  const hn::ScalableTag<std::int32_t> d;
  const std::size_t lanes = hn::Lanes(d);
  const auto zero = hn::Zero(d);
  const auto first_col = hn::Set(d, col + block_cells);
  const auto first_row = hn::Set(d, row + block_cells);
  const auto last_col = hn::Set(d, planes.width + block_cells);
  const auto last_row = hn::Set(d, planes.height + block_cells);
  const auto stride = hn::Set(d, planes.stride);
  const auto find = [&](std::size_t i) HWY_ATTR {
    const auto x = hn::Min(last_col, hn::Max(zero, hn::Add(first_col, hn::LoadU(d, point_col + i))));
    const auto y = hn::Min(last_row, hn::Max(zero, hn::Add(first_row, hn::LoadU(d, point_row + i))));
    hn::StoreU(hn::Add(hn::Mul(y, stride), x), d, index + i);
  };
  std::size_t i = 0;
  for (; i + lanes <= count; i += lanes) find(i);
  if (i < count && count >= lanes) return find(count - lanes);
  for (; i < count; ++i) index[i] = planes.index(col + point_col[i], row + point_row[i]);
}

// Two rows x eight columns stand in columns of two: lane 2 * col + row.
constexpr std::size_t pair_poses = sums_a_row;
// 16 bits hold the sum of 257 bytes; 256 are a whole number of looks.
constexpr std::size_t addends_a_word = 256;

// Pairs of rows, 8 elements wide, at every index.
#if HWY_TARGET <= HWY_AVX2 && HWY_ARCH_X86
// All sums stay in registers, one a row.
HWY_INLINE void AddPairs(const WindowPlanes& planes, const std::int32_t* HWY_RESTRICT index,
                         std::size_t count, std::uint16_t* HWY_RESTRICT sums) {
  const hn::FixedTag<std::uint16_t, pair_poses> d;
  const hn::Rebind<std::uint8_t, decltype(d)> d_byte;
  const auto add = [&](auto sum, const std::uint16_t* pairs) HWY_ATTR {
    return hn::Add(sum, hn::PromoteTo(d, hn::LoadU(d_byte, reinterpret_cast<const std::uint8_t*>(pairs))));
  };
  const std::ptrdiff_t up = 2 * static_cast<std::ptrdiff_t>(planes.stride);
  auto sum0 = hn::Load(d, sums);
  auto sum1 = hn::Load(d, sums + pair_poses);
  auto sum2 = hn::Load(d, sums + 2 * pair_poses);
  auto sum3 = hn::Load(d, sums + 3 * pair_poses);
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint16_t* first = planes.column_of_2 + index[i];
    sum0 = add(sum0, first);
    sum1 = add(sum1, first + up);
    sum2 = add(sum2, first + 2 * up);
    sum3 = add(sum3, first + 3 * up);
  }
  hn::Store(sum0, d, sums);
  hn::Store(sum1, d, sums + pair_poses);
  hn::Store(sum2, d, sums + 2 * pair_poses);
  hn::Store(sum3, d, sums + 3 * pair_poses);
}
#else
HWY_INLINE void AddPairs(const WindowPlanes& planes, const std::int32_t* HWY_RESTRICT index,
                         std::size_t count, std::uint16_t* HWY_RESTRICT sums) {
  const hn::CappedTag<std::uint16_t, pair_poses> d;
  const hn::Rebind<std::uint8_t, decltype(d)> d_byte;
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t pair = 0; pair < sum_rows; ++pair) {
      const auto* first = reinterpret_cast<const std::uint8_t*>(
          planes.column_of_2 + index[i] + 2 * static_cast<std::ptrdiff_t>(pair) * planes.stride);
      for (std::size_t lane = 0; lane < pair_poses; lane += hn::Lanes(d)) {
        std::uint16_t* sum = sums + pair * pair_poses + lane;
        hn::Store(hn::Add(hn::Load(d, sum), hn::PromoteTo(d, hn::LoadU(d_byte, first + lane))), d, sum);
      }
    }
}
#endif

bool ScoreBlock(const WindowPlanes& planes, int col, int row, const std::int32_t* point_col,
                const std::int32_t* point_row, std::size_t points, std::int32_t threshold,
                std::int32_t* scores) {
  constexpr std::size_t points_per_look = 32;
  HWY_ALIGN std::int32_t index[points_per_look];
  HWY_ALIGN std::uint16_t sums[block_poses] = {};
  HWY_ALIGN std::int32_t totals[block_poses] = {};
  std::int32_t largest_total = 0;
  for (std::size_t i = 0; i < points;) {
    const std::size_t count = std::min(points_per_look, points - i);
    WindowIndices(planes, col, row, point_col + i, point_row + i, count, index);
    AddPairs(planes, index, count, sums);
    i += count;
    const std::int64_t rest = 255 * static_cast<std::int64_t>(points - i);
    if (largest_total + LargestSum(sums) + rest < threshold) return false;
    if (i % addends_a_word == 0 || i == points) {
      for (int lane = 0; lane < block_poses; ++lane) {
        totals[lane] += sums[lane];
        sums[lane] = 0;
        largest_total = std::max(largest_total, totals[lane]);
      }
    }
  }
  if (largest_total < threshold) return false;
  for (int r = 0; r < block_cells; ++r)
    for (int c = 0; c < block_cells; ++c)
      scores[r * block_cells + c] = totals[r / 2 * static_cast<int>(pair_poses) + 2 * c + r % 2];
  return true;
}

}  // namespace HWY_NAMESPACE
}  // namespace landfall::kernels
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace landfall::kernels {

namespace scalar {

bool score_block(const WindowPlanes& planes, int col, int row, const std::int32_t* point_col,
                 const std::int32_t* point_row, std::size_t points, std::int32_t threshold,
                 std::int32_t* scores) {
  std::int32_t largest = 0;
  for (int r = 0; r < block_cells; ++r) {
    for (int c = 0; c < block_cells; ++c) {
      std::int32_t sum = 0;
      for (std::size_t i = 0; i < points; ++i) {
        const std::int32_t first = planes.index(col + point_col[i], row + point_row[i]);
        sum += static_cast<std::int32_t>(planes.column_of_2[first + r * planes.stride + c] & 255U);
      }
      scores[r * block_cells + c] = sum;
      largest = std::max(largest, sum);
    }
  }
  return largest >= threshold;
}

}  // namespace scalar

HWY_EXPORT(ScoreBlock);

bool score_block(const WindowPlanes& planes, int col, int row, const std::int32_t* point_col,
                 const std::int32_t* point_row, std::size_t points, std::int32_t threshold,
                 std::int32_t* scores) {
  const auto score = scalar_selected() ? scalar::score_block : HWY_DYNAMIC_DISPATCH(ScoreBlock);
  return score(planes, col, row, point_col, point_row, points, threshold, scores);
}

}  // namespace landfall::kernels
#endif
