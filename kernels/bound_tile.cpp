#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/bound_tile.cpp"
#include <hwy/foreach_target.h>
// foreach_target comes before highway.h
#include <hwy/highway.h>

#include <algorithm>

#include "kernels/bound_tile.hpp"
#include "kernels/isa.hpp"

HWY_BEFORE_NAMESPACE();
namespace landfall::kernels {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

#if HWY_TARGET == HWY_SCALAR
// One lane has no halves; the twin does as well.
bool BoundTile(const BoundPlanes& planes, const BoundPoints& points, int tile_col, int tile_row,
               int threshold, std::int32_t* scratch, std::uint16_t* sums) {
  return scalar::bound_tile(planes, points, tile_col, tile_row, threshold, scratch, sums);
}
#else

using ByteTag = hn::CappedTag<std::uint8_t, tile_cols>;
using WordTag = hn::Repartition<std::uint16_t, ByteTag>;

void TileOffsets(const BoundPlanes& planes, const BoundPoints& points, int tile_col, int tile_row,
                 std::int32_t begin, std::int32_t end, std::int32_t* HWY_RESTRICT offset) {
  const hn::ScalableTag<std::int32_t> d;
  const auto lanes = static_cast<std::int32_t>(hn::Lanes(d));
  const auto zero = hn::Zero(d);
  const auto first_col = hn::Set(d, tile_col);
  const auto first_row = hn::Set(d, tile_row);
  const auto last_col = hn::Set(d, planes.last_col);
  const auto last_row = hn::Set(d, planes.last_row);
  const auto stride = hn::Set(d, planes.stride);
  std::int32_t i = begin;
  for (; i + lanes <= end; i += lanes) {
    const auto col = hn::Min(last_col, hn::Max(zero, hn::Add(first_col, hn::LoadU(d, points.col + i))));
    const auto row = hn::Min(last_row, hn::Max(zero, hn::Add(first_row, hn::LoadU(d, points.row + i))));
    const auto in_plane = hn::Add(hn::Mul(row, stride), col);
    hn::StoreU(hn::Add(in_plane, hn::LoadU(d, points.plane + i)), d, offset + (i - begin));
  }
  for (; i < end; ++i) {
    const int col = std::clamp(tile_col + points.col[i], 0, planes.last_col);
    const int row = std::clamp(tile_row + points.row[i], 0, planes.last_row);
    offset[i - begin] = points.plane[i] + row * planes.stride + col;
  }
}

// Adds up to eight points' bytes to the tile's 16-bit sums: the bytes are summed as bytes first.
// Sums are kept apart for even and odd columns: word w of a row's vector holds column 2 w (even).
HWY_INLINE void AddEightPoints(const std::uint8_t* HWY_RESTRICT data, std::int32_t stride,
                               const std::int32_t* HWY_RESTRICT offset, std::int32_t count, std::size_t part,
                               std::uint16_t* HWY_RESTRICT even, std::uint16_t* HWY_RESTRICT odd) {
  const ByteTag d;
  const WordTag d_word;
  const std::size_t lanes = hn::Lanes(d);
  const std::uint8_t* first = data + offset[0] + part * lanes;
  auto sum0 = hn::LoadU(d, first);
  auto sum1 = hn::LoadU(d, first + stride);
  auto sum2 = hn::LoadU(d, first + 2 * stride);
  auto sum3 = hn::LoadU(d, first + 3 * stride);
  auto sum4 = hn::LoadU(d, first + 4 * stride);
  auto sum5 = hn::LoadU(d, first + 5 * stride);
  auto sum6 = hn::LoadU(d, first + 6 * stride);
  auto sum7 = hn::LoadU(d, first + 7 * stride);
  for (std::int32_t i = 1; i < count; ++i) {
    const std::uint8_t* next = data + offset[i] + part * lanes;
    sum0 = hn::Add(sum0, hn::LoadU(d, next));
    sum1 = hn::Add(sum1, hn::LoadU(d, next + stride));
    sum2 = hn::Add(sum2, hn::LoadU(d, next + 2 * stride));
    sum3 = hn::Add(sum3, hn::LoadU(d, next + 3 * stride));
    sum4 = hn::Add(sum4, hn::LoadU(d, next + 4 * stride));
    sum5 = hn::Add(sum5, hn::LoadU(d, next + 5 * stride));
    sum6 = hn::Add(sum6, hn::LoadU(d, next + 6 * stride));
    sum7 = hn::Add(sum7, hn::LoadU(d, next + 7 * stride));
  }
  const auto low_byte = hn::Set(d_word, 0x00FF);
  const auto widen = [&](std::size_t row, auto sum) HWY_ATTR {
    const std::size_t at = row * (tile_cols / 2) + part * (lanes / 2);
    const auto words = hn::BitCast(d_word, sum);
    hn::Store(hn::SaturatedAdd(hn::Load(d_word, even + at), hn::And(words, low_byte)), d_word, even + at);
    hn::Store(hn::SaturatedAdd(hn::Load(d_word, odd + at), hn::ShiftRight<8>(words)), d_word, odd + at);
  };
  widen(0, sum0);
  widen(1, sum1);
  widen(2, sum2);
  widen(3, sum3);
  widen(4, sum4);
  widen(5, sum5);
  widen(6, sum6);
  widen(7, sum7);
}

constexpr std::size_t half_tile = tile_blocks / 2;

int LargestSum(const std::uint16_t* even, const std::uint16_t* odd) {
  const WordTag d;
  auto largest = hn::Zero(d);
  for (std::size_t i = 0; i < half_tile; i += hn::Lanes(d)) {
    largest = hn::Max(largest, hn::Max(hn::Load(d, even + i), hn::Load(d, odd + i)));
  }
  return hn::GetLane(hn::MaxOfLanes(d, largest));
}

void DoubleSums(std::uint16_t* even, std::uint16_t* odd) {
  const WordTag d;
  for (std::size_t i = 0; i < half_tile; i += hn::Lanes(d)) {
    const auto e = hn::Load(d, even + i);
    const auto o = hn::Load(d, odd + i);
    hn::Store(hn::SaturatedAdd(e, e), d, even + i);
    hn::Store(hn::SaturatedAdd(o, o), d, odd + i);
  }
}

bool BoundTile(const BoundPlanes& planes, const BoundPoints& points, int tile_col, int tile_row,
               int threshold, std::int32_t* scratch, std::uint16_t* sums) {
  constexpr std::int32_t points_per_look = 32;
  HWY_ALIGN std::uint16_t even[half_tile] = {};
  HWY_ALIGN std::uint16_t odd[half_tile] = {};
  const std::size_t parts = tile_cols / hn::Lanes(ByteTag());
  std::int64_t weight_left = 0;
  for (std::int32_t list = 0, begin = 0; list < points.lists; ++list) {
    weight_left += std::int64_t{points.list_end[list] - begin} << (points.lists - 1 - list);
    begin = points.list_end[list];
  }
  for (std::int32_t list = 0, begin = 0; list < points.lists; ++list) {
    const std::int32_t bit = points.lists - 1 - list;
    const std::int32_t end = points.list_end[list];
    if (list > 0) DoubleSums(even, odd);
    TileOffsets(planes, points, tile_col, tile_row, begin, end, scratch);
    for (std::int32_t i = 0; i < end - begin;) {
      const std::int32_t stop = std::min(end - begin, i + points_per_look);
      weight_left -= std::int64_t{stop - i} << bit;
      for (; i < stop; i += 8) {
        const std::int32_t count = std::min(8, stop - i);
        for (std::size_t part = 0; part < parts; ++part) {
          AddEightPoints(planes.data, planes.stride, scratch + i, count, part, even, odd);
        }
      }
      i = stop;
      const std::int64_t largest = std::int64_t{LargestSum(even, odd)} << bit;
      if (largest + bound_levels * weight_left < threshold) return false;
    }
    begin = end;
  }
  for (std::size_t i = 0; i < half_tile; ++i) {
    sums[2 * i] = even[i];
    sums[2 * i + 1] = odd[i];
  }
  return true;
}

#endif
}  // namespace HWY_NAMESPACE
}  // namespace landfall::kernels
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace landfall::kernels {

namespace scalar {
bool bound_tile(const BoundPlanes& planes, const BoundPoints& points, int tile_col, int tile_row,
                int threshold, std::int32_t* /*scratch*/, std::uint16_t* sums) {
  int largest = 0;
  for (int r = 0; r < tile_rows; ++r) {
    for (int c = 0; c < tile_cols; ++c) {
      std::int64_t sum = 0;
      for (std::int32_t list = 0, i = 0; list < points.lists; ++list) {
        for (; i < points.list_end[list]; ++i) {
          const int col = std::clamp(tile_col + points.col[i], 0, planes.last_col) + c;
          const int row = std::clamp(tile_row + points.row[i], 0, planes.last_row) + r;
          sum += std::int64_t{planes.data[points.plane[i] + row * planes.stride + col]}
                 << (points.lists - 1 - list);
        }
      }
      const int saturated = static_cast<int>(std::min<std::int64_t>(sum, 65535));
      sums[r * tile_cols + c] = static_cast<std::uint16_t>(saturated);
      largest = std::max(largest, saturated);
    }
  }
  return largest >= threshold;
}
}  // namespace scalar

HWY_EXPORT(BoundTile);

bool bound_tile(const BoundPlanes& planes, const BoundPoints& points, int tile_col, int tile_row,
                int threshold, std::int32_t* scratch, std::uint16_t* sums) {
  return scalar_selected()
             ? scalar::bound_tile(planes, points, tile_col, tile_row, threshold, scratch, sums)
             : HWY_DYNAMIC_DISPATCH(BoundTile)(planes, points, tile_col, tile_row, threshold, scratch, sums);
}

}  // namespace landfall::kernels
#endif
