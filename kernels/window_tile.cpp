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
using CellTag = hn::ScalableTag<std::int32_t>;

// Elements of the windows that begin at cells of the padded map.
HWY_INLINE hn::Vec<CellTag> WindowsAt(const WindowMaxima& maxima, hn::Vec<CellTag> col,
                                      hn::Vec<CellTag> row) {
  const CellTag d;
  const auto in_block = hn::Set(d, block_cells - 1);
  const auto phase = hn::Or(hn::ShiftLeft<block_shift>(hn::And(row, in_block)), hn::And(col, in_block));
  const auto block = hn::Add(hn::Mul(hn::ShiftRight<block_shift>(row), hn::Set(d, maxima.stride)),
                             hn::ShiftRight<block_shift>(col));
  return hn::Add(hn::Mul(phase, hn::Set(d, maxima.phase_size)), block);
}

TilePoints AllTilePoints(const WindowMaxima& maxima, const std::int32_t* point_col,
                         const std::int32_t* point_row, std::size_t count,
                         std::int32_t* HWY_RESTRICT window) {
  const CellTag d;
  const std::size_t lanes = hn::Lanes(d);
  if (count < lanes) return scalar::tile_points(maxima, point_col, point_row, count, window);
  const auto pad_col = hn::Set(d, WindowMaxima::pad_cols);
  const auto pad_row = hn::Set(d, WindowMaxima::pad_rows);
  auto least_col = hn::Zero(d), most_col = hn::Zero(d), least_row = hn::Zero(d), most_row = hn::Zero(d);
  for (std::size_t end = lanes; end < count + lanes; end += lanes) {
    const std::size_t i = std::min(end, count) - lanes;  // the last ones once more
    const auto col = hn::LoadU(d, point_col + i);
    const auto row = hn::LoadU(d, point_row + i);
    hn::StoreU(WindowsAt(maxima, hn::Add(pad_col, col), hn::Add(pad_row, row)), d, window + i);
    least_col = hn::Min(least_col, col);
    most_col = hn::Max(most_col, col);
    least_row = hn::Min(least_row, row);
    most_row = hn::Max(most_row, row);
  }
  return {.col = point_col,
          .row = point_row,
          .window = window,
          .count = count,
          .least_col = hn::GetLane(hn::MinOfLanes(d, least_col)),
          .most_col = hn::GetLane(hn::MaxOfLanes(d, most_col)),
          .least_row = hn::GetLane(hn::MinOfLanes(d, least_row)),
          .most_row = hn::GetLane(hn::MaxOfLanes(d, most_row))};
}

// index[i]: the window of point i for the tile's first block.
void FirstWindows(const WindowMaxima& maxima, int first_col, int first_row, const std::int32_t* point_col,
                  const std::int32_t* point_row, std::size_t count, std::int32_t* HWY_RESTRICT index) {
  const CellTag d;
  const std::size_t lanes = hn::Lanes(d);
  const auto zero = hn::Zero(d);
  const auto col0 = hn::Set(d, first_col + WindowMaxima::pad_cols);
  const auto row0 = hn::Set(d, first_row + WindowMaxima::pad_rows);
  const auto last_col = hn::Set(d, maxima.width + WindowMaxima::pad_cols);
  const auto last_row = hn::Set(d, maxima.height + WindowMaxima::pad_rows);
  const auto find = [&](std::size_t i) HWY_ATTR {
    const auto col = hn::Min(last_col, hn::Max(zero, hn::Add(col0, hn::LoadU(d, point_col + i))));
    const auto row = hn::Min(last_row, hn::Max(zero, hn::Add(row0, hn::LoadU(d, point_row + i))));
    hn::StoreU(WindowsAt(maxima, col, row), d, index + i);
  };
  std::size_t i = 0;
  for (; i + lanes <= count; i += lanes) find(i);
  if (i < count && count >= lanes) return find(count - lanes);
  for (; i < count; ++i) index[i] = maxima.tile_index(first_col + point_col[i], first_row + point_row[i]);
}

// No window of the tile's first block begins off the padded map.
bool IsInside(const WindowMaxima& maxima, int first_col, int first_row, const TilePoints& points) {
  return first_col + points.least_col + WindowMaxima::pad_cols >= 0 &&
         first_col + points.most_col <= maxima.width &&
         first_row + points.least_row + WindowMaxima::pad_rows >= 0 &&
         first_row + points.most_row <= maxima.height;
}

// Rows of levels, and the sums of 16 bytes of each at every offset.
struct LevelRows {
  const std::uint8_t* level;
  std::ptrdiff_t stride;
};
// 16 bits hold the sum of 516 levels; 512 are a whole number of looks.
constexpr std::size_t levels_a_word = 512;

#if HWY_TARGET <= HWY_AVX2 && HWY_ARCH_X86
// Two points are added as bytes before they are widened. All sums stay in registers, one a row.
template <int Count>
HWY_INLINE void AddLevels(const LevelRows& rows, const std::int32_t* HWY_RESTRICT offset, std::size_t count,
                          std::uint16_t* HWY_RESTRICT sums) {
  const hn::FixedTag<std::uint16_t, sums_a_row> d;
  const hn::Rebind<std::uint8_t, decltype(d)> d_byte;
  const auto add = [&](auto sum, const std::uint8_t* a, const std::uint8_t* b) HWY_ATTR {
    return hn::Add(sum, hn::PromoteTo(d, hn::Add(hn::LoadU(d_byte, a), hn::LoadU(d_byte, b))));
  };
  auto sum0 = hn::Load(d, sums);
  auto sum1 = sum0, sum2 = sum0, sum3 = sum0;
  if constexpr (Count > 1) sum1 = hn::Load(d, sums + sums_a_row);
  if constexpr (Count > 2) sum2 = hn::Load(d, sums + 2 * sums_a_row);
  if constexpr (Count > 3) sum3 = hn::Load(d, sums + 3 * sums_a_row);
  std::size_t i = 0;
  for (; i + 2 <= count; i += 2) {
    const std::uint8_t* a = rows.level + offset[i];
    const std::uint8_t* b = rows.level + offset[i + 1];
    sum0 = add(sum0, a, b);
    if constexpr (Count > 1) sum1 = add(sum1, a + rows.stride, b + rows.stride);
    if constexpr (Count > 2) sum2 = add(sum2, a + 2 * rows.stride, b + 2 * rows.stride);
    if constexpr (Count > 3) sum3 = add(sum3, a + 3 * rows.stride, b + 3 * rows.stride);
  }
  hn::Store(sum0, d, sums);
  if constexpr (Count > 1) hn::Store(sum1, d, sums + sums_a_row);
  if constexpr (Count > 2) hn::Store(sum2, d, sums + 2 * sums_a_row);
  if constexpr (Count > 3) hn::Store(sum3, d, sums + 3 * sums_a_row);
  if (i == count) return;
  for (std::size_t row = 0; row < Count; ++row)
    for (std::size_t lane = 0; lane < sums_a_row; ++lane)
      sums[row * sums_a_row + lane] =
          static_cast<std::uint16_t>(sums[row * sums_a_row + lane] +
                                     rows.level[offset[i] + static_cast<std::ptrdiff_t>(row) * rows.stride +
                                                static_cast<std::ptrdiff_t>(lane)]);
}
#else
template <int Count>
HWY_INLINE void AddLevels(const LevelRows& rows, const std::int32_t* HWY_RESTRICT offset, std::size_t count,
                          std::uint16_t* HWY_RESTRICT sums) {
  const hn::CappedTag<std::uint16_t, sums_a_row> d;
  const hn::Rebind<std::uint8_t, decltype(d)> d_byte;
  const auto add_all = [&](const auto& levels_at) HWY_ATTR {
    for (std::size_t row = 0; row < Count; ++row)
      for (std::size_t lane = 0; lane < sums_a_row; lane += hn::Lanes(d)) {
        const auto at = static_cast<std::ptrdiff_t>(row) * rows.stride + static_cast<std::ptrdiff_t>(lane);
        std::uint16_t* sum = sums + row * sums_a_row + lane;
        hn::Store(hn::Add(hn::Load(d, sum), hn::PromoteTo(d, levels_at(at))), d, sum);
      }
  };
  std::size_t i = 0;
  for (; i + 2 <= count; i += 2) {
    const std::uint8_t* a = rows.level + offset[i];
    const std::uint8_t* b = rows.level + offset[i + 1];
    add_all([&](std::ptrdiff_t at)
                HWY_ATTR { return hn::Add(hn::LoadU(d_byte, a + at), hn::LoadU(d_byte, b + at)); });
  }
  if (i == count) return;
  const std::uint8_t* a = rows.level + offset[i];
  add_all([&](std::ptrdiff_t at) HWY_ATTR { return hn::LoadU(d_byte, a + at); });
}
#endif

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

std::uint64_t BoundWindows(const WindowMaxima& maxima, int first_col, int first_row, const TilePoints& points,
                           std::int32_t threshold, std::uint64_t blocks, std::int32_t* bounds) {
  constexpr std::size_t points_per_look = 64;
  if (blocks == 0) return 0;
  const int first = std::countr_zero(blocks) / tile_cols;
  const int count_rows = (63 - std::countl_zero(blocks)) / tile_cols - first + 1;
  const auto add_levels = count_rows == 1   ? AddLevels<1>
                          : count_rows == 2 ? AddLevels<2>
                          : count_rows == 3 ? AddLevels<3>
                                            : AddLevels<4>;
  const bool inside = IsInside(maxima, first_col, first_row, points);
  const std::ptrdiff_t tile =
      inside ? static_cast<std::ptrdiff_t>(first_row / block_cells) * maxima.stride + first_col / block_cells
             : 0;
  const LevelRows rows{.level = maxima.level + tile + static_cast<std::ptrdiff_t>(first) * maxima.stride,
                       .stride = maxima.stride};
  HWY_ALIGN std::int32_t index[points_per_look];
  HWY_ALIGN std::uint16_t sums[row_sums] = {};
  HWY_ALIGN std::uint16_t counted[row_sums];
  ExpandBits(blocks, counted);
  std::fill_n(bounds, row_sums, 0);
  std::uint64_t reaching = threshold <= 0 ? ~std::uint64_t{0} : 0;
  std::int32_t flushed = 0;  // the largest bound's, so far
  for (std::size_t i = 0; i < points.count;) {
    const std::size_t count = std::min(points_per_look, points.count - i);
    if (!inside) FirstWindows(maxima, first_col, first_row, points.col + i, points.row + i, count, index);
    add_levels(rows, inside ? points.window + i : index, count,
               sums + static_cast<std::size_t>(first) * sums_a_row);
    i += count;
    const std::int64_t rest = window_levels * static_cast<std::int64_t>(points.count - i);
    if (flushed + LargestSum(sums, counted) + rest < threshold) return 0;
    if (i % levels_a_word != 0 && i != points.count) continue;
    reaching = Flush(sums, bounds, threshold);
    if (i != points.count)
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

TilePoints tile_points(const WindowMaxima& maxima, const std::int32_t* col, const std::int32_t* row,
                       std::size_t count, std::int32_t* window) {
  TilePoints points{.col = col, .row = row, .window = window, .count = count};
  for (std::size_t i = 0; i < count; ++i) {
    window[i] = maxima.index(col[i] + WindowMaxima::pad_cols, row[i] + WindowMaxima::pad_rows);
    points.least_col = std::min(points.least_col, col[i]);
    points.most_col = std::max(points.most_col, col[i]);
    points.least_row = std::min(points.least_row, row[i]);
    points.most_row = std::max(points.most_row, row[i]);
  }
  return points;
}

std::uint64_t bound_windows(const WindowMaxima& maxima, int first_col, int first_row,
                            const TilePoints& points, std::int32_t threshold, std::uint64_t blocks,
                            std::int32_t* bounds) {
  std::uint64_t reaching = 0;
  for (int block = 0; block < tile_blocks; ++block) {
    std::int32_t sum = 0;
    for (std::size_t i = 0; i < points.count; ++i) {
      const std::int32_t first = maxima.tile_index(first_col + points.col[i], first_row + points.row[i]);
      sum += maxima.level[first + block / tile_cols * maxima.stride + block % tile_cols];
    }
    bounds[block] = sum;
    if (sum >= threshold) reaching |= std::uint64_t{1} << block;
  }
  return reaching & blocks;
}

}  // namespace scalar

HWY_EXPORT(AllTilePoints);
HWY_EXPORT(BoundWindows);

TilePoints tile_points(const WindowMaxima& maxima, const std::int32_t* col, const std::int32_t* row,
                       std::size_t count, std::int32_t* window) {
  return scalar_selected() ? scalar::tile_points(maxima, col, row, count, window)
                           : HWY_DYNAMIC_DISPATCH(AllTilePoints)(maxima, col, row, count, window);
}

std::uint64_t bound_windows(const WindowMaxima& maxima, int first_col, int first_row,
                            const TilePoints& points, std::int32_t threshold, std::uint64_t blocks,
                            std::int32_t* bounds) {
  const auto bound = scalar_selected() ? scalar::bound_windows : HWY_DYNAMIC_DISPATCH(BoundWindows);
  return bound(maxima, first_col, first_row, points, threshold, blocks, bounds);
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
