#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/window_tile.cpp"
#include <hwy/foreach_target.h>
// foreach_target comes before highway.h
#include <hwy/highway.h>

#include <algorithm>
#include <bit>

#include "kernels/isa.hpp"
#include "kernels/row_sums-inl.hpp"
#include "kernels/window_tile.hpp"

HWY_BEFORE_NAMESPACE();
namespace landfall::kernels {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

constexpr int block_shift = std::countr_zero(static_cast<unsigned>(block_cells));

// index[i]: the window of point i for the tile's first block; `count` rounded up to whole vectors.
void FirstWindows(const WindowMaxima& maxima, int first_col, int first_row, const std::int32_t* point_col,
                  const std::int32_t* point_row, std::size_t count, std::int32_t* HWY_RESTRICT index) {
  const hn::ScalableTag<std::int32_t> d;
  const std::size_t lanes = hn::Lanes(d);
  const auto zero = hn::Zero(d);
  const auto col0 = hn::Set(d, first_col + WindowMaxima::pad_cols);
  const auto row0 = hn::Set(d, first_row + WindowMaxima::pad_rows);
  const auto last_col = hn::Set(d, maxima.width + WindowMaxima::pad_cols);
  const auto last_row = hn::Set(d, maxima.height + WindowMaxima::pad_rows);
  const auto in_block = hn::Set(d, block_cells - 1);
  const auto phase_size = hn::Set(d, maxima.phase_size);
  const auto stride = hn::Set(d, maxima.stride);
  std::size_t i = 0;
  for (; i + lanes <= count; i += lanes) {
    const auto col = hn::Min(last_col, hn::Max(zero, hn::Add(col0, hn::LoadU(d, point_col + i))));
    const auto row = hn::Min(last_row, hn::Max(zero, hn::Add(row0, hn::LoadU(d, point_row + i))));
    const auto phase = hn::Or(hn::ShiftLeft<block_shift>(hn::And(row, in_block)), hn::And(col, in_block));
    const auto block =
        hn::Add(hn::Mul(hn::ShiftRight<block_shift>(row), stride), hn::ShiftRight<block_shift>(col));
    hn::StoreU(hn::Add(hn::Mul(phase, phase_size), block), d, index + i);
  }
  for (; i < count; ++i) index[i] = maxima.tile_index(first_col + point_col[i], first_row + point_row[i]);
}

// The rows of blocks among which all counted ones are.
struct RowRange {
  std::size_t first = 0;
  std::size_t count = 0;
};

RowRange CountedRows(const std::uint16_t* HWY_RESTRICT counted) {
  const auto any = [&](std::size_t row) {
    std::uint16_t bits = 0;
    for (std::size_t lane = 0; lane < sums_a_row; ++lane) bits |= counted[row * sums_a_row + lane];
    return bits != 0;
  };
  RowRange rows{.first = 0, .count = sum_rows};
  while (rows.count > 1 && !any(rows.first + rows.count - 1)) --rows.count;
  for (; rows.count > 1 && !any(rows.first); --rows.count) ++rows.first;
  return rows;
}

bool BoundWindows(const WindowMaxima& maxima, int first_col, int first_row, const std::int32_t* point_col,
                  const std::int32_t* point_row, std::size_t points, std::int32_t threshold,
                  const std::uint16_t* counted, std::int32_t* bounds) {
  constexpr std::size_t points_per_look = 32;
  const RowRange range = CountedRows(counted);
  const Rows rows{.bytes = maxima.window_max + static_cast<std::ptrdiff_t>(range.first) * maxima.stride,
                  .row_bytes = maxima.stride};
  const auto add_rows = range.count == 1   ? AddRows<1, 1>
                        : range.count == 2 ? AddRows<1, 2>
                        : range.count == 3 ? AddRows<1, 3>
                                           : AddRows<1, 4>;
  HWY_ALIGN std::int32_t index[points_per_look];
  HWY_ALIGN std::uint16_t sums[row_sums] = {};
  std::int32_t flushed = 0;  // the largest bound's, so far
  std::fill_n(bounds, row_sums, 0);
  for (std::size_t i = 0; i < points;) {
    const std::size_t count = std::min(points_per_look, points - i);
    FirstWindows(maxima, first_col, first_row, point_col + i, point_row + i, count, index);
    add_rows(rows, index, count, sums + range.first * sums_a_row);
    i += count;
    const std::int64_t rest = 255 * static_cast<std::int64_t>(points - i);
    if (flushed + LargestSum(sums, counted) + rest < threshold) return false;
    if (i % addends_a_word != 0 && i != points) continue;
    flushed = 0;
    for (std::size_t lane = 0; lane < row_sums; ++lane) {
      bounds[lane] += sums[lane];
      sums[lane] = 0;
      if (counted[lane] != 0) flushed = std::max(flushed, bounds[lane]);
    }
  }
  return flushed >= threshold;
}

}  // namespace HWY_NAMESPACE
}  // namespace landfall::kernels
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace landfall::kernels {

namespace scalar {

bool bound_windows(const WindowMaxima& maxima, int first_col, int first_row, const std::int32_t* point_col,
                   const std::int32_t* point_row, std::size_t points, std::int32_t threshold,
                   const std::uint16_t* counted, std::int32_t* bounds) {
  std::int32_t largest = 0;
  for (int lane = 0; lane < tile_blocks; ++lane) {
    std::int32_t sum = 0;
    for (std::size_t i = 0; i < points; ++i) {
      const std::int32_t first = maxima.tile_index(first_col + point_col[i], first_row + point_row[i]);
      sum += maxima.window_max[first + lane / tile_cols * maxima.stride + lane % tile_cols];
    }
    bounds[lane] = sum;
    if (counted[lane] != 0) largest = std::max(largest, sum);
  }
  return largest >= threshold;
}

}  // namespace scalar

HWY_EXPORT(BoundWindows);

bool bound_windows(const WindowMaxima& maxima, int first_col, int first_row, const std::int32_t* point_col,
                   const std::int32_t* point_row, std::size_t points, std::int32_t threshold,
                   const std::uint16_t* counted, std::int32_t* bounds) {
  const auto bound = scalar_selected() ? scalar::bound_windows : HWY_DYNAMIC_DISPATCH(BoundWindows);
  return bound(maxima, first_col, first_row, point_col, point_row, points, threshold, counted, bounds);
}

}  // namespace landfall::kernels
#endif
