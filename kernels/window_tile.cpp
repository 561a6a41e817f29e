#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/window_tile.cpp"
#include <hwy/foreach_target.h>
// foreach_target comes before highway.h
#include <hwy/highway.h>

#include <algorithm>
#include <bit>
#include <cstring>

#include "kernels/isa.hpp"
#include "kernels/row_sums-inl.hpp"
#include "kernels/window_tile.hpp"

HWY_BEFORE_NAMESPACE();
namespace landfall::kernels {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

constexpr int block_shift = std::countr_zero(static_cast<unsigned>(block_cells));

// index[i]: the window of point i for the tile's first block.
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
  const auto find = [&](std::size_t i) HWY_ATTR {
    const auto col = hn::Min(last_col, hn::Max(zero, hn::Add(col0, hn::LoadU(d, point_col + i))));
    const auto row = hn::Min(last_row, hn::Max(zero, hn::Add(row0, hn::LoadU(d, point_row + i))));
    const auto phase = hn::Or(hn::ShiftLeft<block_shift>(hn::And(row, in_block)), hn::And(col, in_block));
    const auto block =
        hn::Add(hn::Mul(hn::ShiftRight<block_shift>(row), stride), hn::ShiftRight<block_shift>(col));
    hn::StoreU(hn::Add(hn::Mul(phase, phase_size), block), d, index + i);
  };
  std::size_t i = 0;
  for (; i + lanes <= count; i += lanes) find(i);
  if (i < count && count >= lanes) return find(count - lanes);
  for (; i < count; ++i) index[i] = maxima.tile_index(first_col + point_col[i], first_row + point_row[i]);
}

// All ones for every bit that is set.
void ExpandBits(std::uint64_t bits, std::uint16_t* HWY_RESTRICT words) {
  const hn::CappedTag<std::uint16_t, row_sums / 2> d;
  for (std::size_t lane = 0; lane < row_sums; lane += hn::Lanes(d)) {
    const std::uint64_t some = bits >> lane;
    std::uint8_t bytes[sizeof(some)];
    std::memcpy(bytes, &some, sizeof(some));
    hn::Store(hn::VecFromMask(d, hn::LoadMaskBits(d, bytes)), d, words + lane);
  }
}

// Adds sums to bounds, and empties them. Bits of the bounds that reach `threshold`.
std::uint64_t Flush(std::uint16_t* HWY_RESTRICT sums, std::int32_t* HWY_RESTRICT bounds,
                    std::int32_t threshold) {
  const hn::CappedTag<std::int32_t, sums_a_row> d;
  const hn::Rebind<std::uint16_t, decltype(d)> d_sum;
  const auto bar = hn::Set(d, threshold);
  std::uint64_t reaching = 0;
  for (std::size_t lane = 0; lane < row_sums; lane += hn::Lanes(d)) {
    const auto bound = hn::Add(hn::LoadU(d, bounds + lane), hn::PromoteTo(d, hn::Load(d_sum, sums + lane)));
    hn::StoreU(bound, d, bounds + lane);
    hn::Store(hn::Zero(d_sum), d_sum, sums + lane);
    std::uint8_t some[8] = {};
    hn::StoreMaskBits(d, hn::Not(hn::Lt(bound, bar)), some);
    std::uint64_t bits = 0;
    std::memcpy(&bits, some, sizeof(bits));
    reaching |= bits << lane;
  }
  return reaching;
}

std::uint64_t BoundWindows(const WindowMaxima& maxima, int first_col, int first_row,
                           const std::int32_t* point_col, const std::int32_t* point_row, std::size_t points,
                           std::int32_t threshold, std::uint64_t blocks, std::int32_t* bounds) {
  constexpr std::size_t points_per_look = 32;
  if (blocks == 0) return 0;
  const int first = std::countr_zero(blocks) / tile_cols;
  const int last = (63 - std::countl_zero(blocks)) / tile_cols;
  const Rows rows{.bytes = maxima.window_max + static_cast<std::ptrdiff_t>(first) * maxima.stride,
                  .row_bytes = maxima.stride};
  const int count_rows = last - first + 1;
  const auto add_rows = count_rows == 1   ? AddRows<1, 1>
                        : count_rows == 2 ? AddRows<1, 2>
                        : count_rows == 3 ? AddRows<1, 3>
                                          : AddRows<1, 4>;
  HWY_ALIGN std::int32_t index[points_per_look];
  HWY_ALIGN std::uint16_t sums[row_sums] = {};
  HWY_ALIGN std::uint16_t counted[row_sums];
  ExpandBits(blocks, counted);
  std::fill_n(bounds, row_sums, 0);
  std::uint64_t reaching = threshold <= 0 ? ~std::uint64_t{0} : 0;
  std::int32_t flushed = 0;  // the largest bound's, so far
  for (std::size_t i = 0; i < points;) {
    const std::size_t count = std::min(points_per_look, points - i);
    FirstWindows(maxima, first_col, first_row, point_col + i, point_row + i, count, index);
    add_rows(rows, index, count, sums + static_cast<std::size_t>(first) * sums_a_row);
    i += count;
    const std::int64_t rest = 255 * static_cast<std::int64_t>(points - i);
    if (flushed + LargestSum(sums, counted) + rest < threshold) return 0;
    if (i % addends_a_word != 0 && i != points) continue;
    reaching = Flush(sums, bounds, threshold);
    if (i != points)
      for (std::uint64_t left = blocks; left != 0; left &= left - 1)
        flushed = std::max(flushed, bounds[std::countr_zero(left)]);
  }
  return reaching & blocks;
}

}  // namespace HWY_NAMESPACE
}  // namespace landfall::kernels
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace landfall::kernels {

namespace scalar {

std::uint64_t bound_windows(const WindowMaxima& maxima, int first_col, int first_row,
                            const std::int32_t* point_col, const std::int32_t* point_row, std::size_t points,
                            std::int32_t threshold, std::uint64_t blocks, std::int32_t* bounds) {
  std::uint64_t reaching = 0;
  for (int block = 0; block < tile_blocks; ++block) {
    std::int32_t sum = 0;
    for (std::size_t i = 0; i < points; ++i) {
      const std::int32_t first = maxima.tile_index(first_col + point_col[i], first_row + point_row[i]);
      sum += maxima.window_max[first + block / tile_cols * maxima.stride + block % tile_cols];
    }
    bounds[block] = sum;
    if (sum >= threshold) reaching |= std::uint64_t{1} << block;
  }
  return reaching & blocks;
}

}  // namespace scalar

HWY_EXPORT(BoundWindows);

std::uint64_t bound_windows(const WindowMaxima& maxima, int first_col, int first_row,
                            const std::int32_t* point_col, const std::int32_t* point_row, std::size_t points,
                            std::int32_t threshold, std::uint64_t blocks, std::int32_t* bounds) {
  const auto bound = scalar_selected() ? scalar::bound_windows : HWY_DYNAMIC_DISPATCH(BoundWindows);
  return bound(maxima, first_col, first_row, point_col, point_row, points, threshold, blocks, bounds);
}

std::uint64_t row_by_row(std::uint64_t lanes) {
  // Every other bit of 32, moved together.
  const auto every_other = [](std::uint64_t bits) {
    bits &= 0x55555555;
    bits = (bits | bits >> 1) & 0x33333333;
    bits = (bits | bits >> 2) & 0x0F0F0F0F;
    bits = (bits | bits >> 4) & 0x00FF00FF;
    return (bits | bits >> 8) & 0xFFFF;
  };
  std::uint64_t blocks = 0;
  for (int row = 0; row < tile_rows; ++row)
    blocks |= every_other(lanes >> tile_lane(0, row)) << (row * tile_cols);
  return blocks;
}

}  // namespace landfall::kernels
#endif
