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
void BoundTiles(const BoundPlanes& planes, const BoundPoints& points, int tile_col, int tile_row, int tiles,
                int threshold, const std::uint16_t* allowed, std::int32_t* scratch, std::uint16_t* sums,
                std::uint16_t* largest) {
  scalar::bound_tiles(planes, points, tile_col, tile_row, tiles, threshold, allowed, scratch, sums, largest);
}
#else

using ByteTag = hn::CappedTag<std::uint8_t, tile_blocks>;
using WordTag = hn::Repartition<std::uint16_t, ByteTag>;

// First bytes of the points' tiles.
void TileOffsets(const BoundPlanes& planes, const BoundPoints& points, int tile_col, int tile_row,
                 std::int32_t begin, std::int32_t end, std::int32_t* HWY_RESTRICT offset) {
  const hn::CappedTag<std::int32_t, point_padding> d;
  const auto lanes = static_cast<std::int32_t>(hn::Lanes(d));
  const auto zero = hn::Zero(d);
  const auto first_col = hn::Set(d, tile_col);
  const auto first_row = hn::Set(d, tile_row);
  const auto last_col = hn::Set(d, planes.last_col);
  const auto last_row = hn::Set(d, planes.last_row);
  const auto stride = hn::Set(d, planes.stride);
  for (std::int32_t i = begin; i < end; i += lanes) {
    const auto col = hn::Min(last_col, hn::Max(zero, hn::Add(first_col, hn::LoadU(d, points.col + i))));
    const auto row = hn::Min(last_row, hn::Max(zero, hn::Add(first_row, hn::LoadU(d, points.row + i))));
    const auto in_plane = hn::Add(hn::Mul(row, stride), col);
    hn::StoreU(hn::ShiftLeft<2>(hn::Add(in_plane, hn::LoadU(d, points.plane + i))), d, offset + (i - begin));
  }
}

// Sums of one vector of neighbouring blocks: word w of `even` belongs to byte 2 w, of `odd` to the next.
struct Sums {
  hn::Vec<WordTag> even;
  hn::Vec<WordTag> odd;

  HWY_INLINE void add(hn::Vec<ByteTag> bytes) {
    const WordTag d;
    const auto words = hn::BitCast(d, bytes);
    even = hn::SaturatedAdd(even, hn::And(words, hn::Set(d, 0x00FF)));
    odd = hn::SaturatedAdd(odd, hn::ShiftRight<8>(words));
  }
  HWY_INLINE void redouble() {
    even = hn::SaturatedAdd(even, even);
    odd = hn::SaturatedAdd(odd, odd);
  }
  HWY_INLINE hn::Vec<WordTag> largest() const { return hn::Max(even, odd); }
  // As the vector that begins at byte `at` of a tile.
  HWY_INLINE void store(std::size_t at, std::uint16_t* HWY_RESTRICT sums) const {
    const WordTag d;
    hn::StoreU(even, d, sums + at / 2);
    hn::StoreU(odd, d, sums + tile_blocks / 2 + at / 2);
  }
};

// The sums of `Vectors` (1, 2 or 4) neighbouring vectors stay in registers; up to eight points' bytes are
// added as bytes first.
template <int Vectors>
bool BoundVectors(const BoundPlanes& planes, const BoundPoints& points, int tile_row, int tile_col,
                  std::size_t first_byte, int threshold, std::int32_t* HWY_RESTRICT offset,
                  std::uint16_t* HWY_RESTRICT sums) {
  constexpr std::int32_t points_per_look = 32;
  constexpr std::int32_t points_per_byte = 255 / bound_levels;
  const ByteTag d;
  const std::size_t lanes = hn::Lanes(d);
  const auto zero = hn::Zero(WordTag());
  Sums sum0{zero, zero}, sum1{zero, zero}, sum2{zero, zero}, sum3{zero, zero};
  std::int64_t weight_left = 0;
  for (std::int32_t list = 0; list < points.lists; ++list)
    weight_left += std::int64_t{points.list_end[list] - points.list_begin[list]} << (points.lists - 1 - list);
  const std::uint8_t* HWY_RESTRICT data =
      reinterpret_cast<const std::uint8_t*>(planes.column_of_4) + first_byte;
  for (std::int32_t list = 0; list < points.lists; ++list) {
    const std::int32_t bit = points.lists - 1 - list;
    const std::int32_t begin = points.list_begin[list];
    const std::int32_t end = points.list_end[list];
    if (list > 0) {
      sum0.redouble();
      if constexpr (Vectors > 1) sum1.redouble();
      if constexpr (Vectors > 2) sum2.redouble();
      if constexpr (Vectors > 2) sum3.redouble();
    }
    TileOffsets(planes, points, tile_col, tile_row, begin, end, offset);
    for (std::int32_t i = 0; i < end - begin;) {
      const std::int32_t look = std::min(end - begin, i + points_per_look);
      weight_left -= std::int64_t{look - i} << bit;
      while (i < look) {
        const std::int32_t stop = std::min(look, i + points_per_byte);
        auto bytes0 = hn::LoadU(d, data + offset[i]);
        auto bytes1 = bytes0, bytes2 = bytes0, bytes3 = bytes0;
        if constexpr (Vectors > 1) bytes1 = hn::LoadU(d, data + offset[i] + lanes);
        if constexpr (Vectors > 2) bytes2 = hn::LoadU(d, data + offset[i] + 2 * lanes);
        if constexpr (Vectors > 2) bytes3 = hn::LoadU(d, data + offset[i] + 3 * lanes);
        for (++i; i < stop; ++i) {
          const std::uint8_t* next = data + offset[i];
          bytes0 = hn::Add(bytes0, hn::LoadU(d, next));
          if constexpr (Vectors > 1) bytes1 = hn::Add(bytes1, hn::LoadU(d, next + lanes));
          if constexpr (Vectors > 2) bytes2 = hn::Add(bytes2, hn::LoadU(d, next + 2 * lanes));
          if constexpr (Vectors > 2) bytes3 = hn::Add(bytes3, hn::LoadU(d, next + 3 * lanes));
        }
        sum0.add(bytes0);
        if constexpr (Vectors > 1) sum1.add(bytes1);
        if constexpr (Vectors > 2) sum2.add(bytes2);
        if constexpr (Vectors > 2) sum3.add(bytes3);
      }
      if (bound_levels * weight_left >= threshold) continue;
      auto largest = sum0.largest();
      if constexpr (Vectors > 1) largest = hn::Max(largest, sum1.largest());
      if constexpr (Vectors > 2) largest = hn::Max(largest, hn::Max(sum2.largest(), sum3.largest()));
      const std::int64_t most = std::int64_t{hn::GetLane(hn::MaxOfLanes(WordTag(), largest))} << bit;
      if (most + bound_levels * weight_left < threshold) return false;
    }
  }
  const auto store = [&](const Sums& sum, std::size_t vector) HWY_ATTR {
    const std::size_t at = first_byte + vector * lanes;
    sum.store(at % tile_blocks, sums + at / tile_blocks * tile_blocks);
  };
  store(sum0, 0);
  if constexpr (Vectors > 1) store(sum1, 1);
  if constexpr (Vectors > 2) store(sum2, 2);
  if constexpr (Vectors > 2) store(sum3, 3);
  return true;
}

std::uint16_t KeepAllowed(const std::uint16_t* HWY_RESTRICT allowed, std::uint16_t* HWY_RESTRICT sums) {
  const WordTag d;
  auto largest = hn::Zero(d);
  for (std::size_t i = 0; i < tile_blocks; i += hn::Lanes(d)) {
    const auto kept = hn::And(hn::LoadU(d, allowed + i), hn::LoadU(d, sums + i));
    hn::StoreU(kept, d, sums + i);
    largest = hn::Max(largest, kept);
  }
  return hn::GetLane(hn::MaxOfLanes(d, largest));
}

void BoundTiles(const BoundPlanes& planes, const BoundPoints& points, int tile_col, int tile_row, int tiles,
                int threshold, const std::uint16_t* allowed, std::int32_t* scratch, std::uint16_t* sums,
                std::uint16_t* largest) {
  const std::size_t lanes = hn::Lanes(ByteTag());
  const std::size_t bytes = static_cast<std::size_t>(tiles) * tile_blocks;
  // The last vectors may reach past the run: their sums end here.
  HWY_ALIGN std::uint16_t run[most_tiles * tile_blocks];
  for (int tile = 0; tile < tiles; ++tile) largest[tile] = 1;
  for (std::size_t at = 0; at < bytes;) {
    const std::size_t vectors_left = (bytes - at) / lanes;
    const std::size_t vectors = vectors_left >= 3 ? 4 : vectors_left;
    const bool bounded =
        vectors == 4   ? BoundVectors<4>(planes, points, tile_row, tile_col, at, threshold, scratch, run)
        : vectors == 2 ? BoundVectors<2>(planes, points, tile_row, tile_col, at, threshold, scratch, run)
                       : BoundVectors<1>(planes, points, tile_row, tile_col, at, threshold, scratch, run);
    const std::size_t end = std::min(bytes, at + vectors * lanes);
    if (!bounded)
      for (std::size_t tile = at / tile_blocks; tile * tile_blocks < end; ++tile) largest[tile] = 0;
    at = end;
  }
  std::copy_n(run, bytes, sums);
  for (int tile = 0; tile < tiles; ++tile)
    if (largest[tile] != 0)
      largest[tile] = KeepAllowed(allowed + tile * tile_blocks, sums + tile * tile_blocks);
}

#endif
}  // namespace HWY_NAMESPACE
}  // namespace landfall::kernels
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace landfall::kernels {

namespace scalar {
void bound_tiles(const BoundPlanes& planes, const BoundPoints& points, int tile_col, int tile_row, int tiles,
                 int /*threshold*/, const std::uint16_t* allowed, std::int32_t* /*scratch*/,
                 std::uint16_t* sums, std::uint16_t* largest) {
  for (int tile = 0; tile < tiles; ++tile) {
    largest[tile] = 0;
    for (int lane = 0; lane < tile_blocks; ++lane) {
      std::int64_t sum = 0;
      for (std::int32_t list = 0; list < points.lists; ++list) {
        for (std::int32_t i = points.list_begin[list]; i < points.list_end[list]; ++i) {
          // The run is clamped as a whole.
          const int col = std::clamp(tile_col + points.col[i], 0, planes.last_col) + tile * tile_cols;
          const int row = std::clamp(tile_row + points.row[i], 0, planes.last_row);
          const std::uint32_t column =
              planes.column_of_4[points.plane[i] + row * planes.stride + col + lane_col(lane)];
          sum += std::int64_t{(column >> (8 * lane_row(lane))) & 0xFFU} << (points.lists - 1 - list);
        }
      }
      const int at = tile * tile_blocks + lane;
      sums[at] = static_cast<std::uint16_t>(std::min<std::int64_t>(sum, 65535) & allowed[at]);
      largest[tile] = std::max(largest[tile], sums[at]);
    }
  }
}
}  // namespace scalar

HWY_EXPORT(BoundTiles);

void bound_tiles(const BoundPlanes& planes, const BoundPoints& points, int tile_col, int tile_row, int tiles,
                 int threshold, const std::uint16_t* allowed, std::int32_t* scratch, std::uint16_t* sums,
                 std::uint16_t* largest) {
  const auto bound = scalar_selected() ? scalar::bound_tiles : HWY_DYNAMIC_DISPATCH(BoundTiles);
  bound(planes, points, tile_col, tile_row, tiles, threshold, allowed, scratch, sums, largest);
}

}  // namespace landfall::kernels
#endif
