#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/bound_tile.cpp"
#include <hwy/foreach_target.h>
// foreach_target comes before highway.h
#include <hwy/highway.h>

#include <algorithm>
#include <cstring>

#include "kernels/bound_tile.hpp"
#include "kernels/isa.hpp"

HWY_BEFORE_NAMESPACE();
namespace landfall::kernels {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

#if HWY_TARGET == HWY_SCALAR
// One lane has no halves; the twin does as well.
void BoundTiles(const BoundPlanes& planes, const BoundPoints& points, int tile_col, int tile_row, int tiles,
                int threshold, const std::uint64_t* allowed, std::int32_t* scratch, std::uint16_t* sums,
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

// Words of the blocks whose bits are set, the bit of the first in the lowest place.
HWY_INLINE hn::Vec<WordTag> KeepLanes(hn::Vec<WordTag> words, std::uint64_t bits) {
  const WordTag d;
  std::uint8_t bytes[sizeof(bits)];
  std::memcpy(bytes, &bits, sizeof(bits));
  return hn::IfThenElseZero(hn::LoadMaskBits(d, bytes), words);
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
  // Of the blocks allowed in the tile, as the vector that begins at byte `at` of it.
  HWY_INLINE hn::Vec<WordTag> largest(std::uint64_t allowed, std::size_t at) const {
    return hn::Max(KeepLanes(even, allowed >> (at / 2)),
                   KeepLanes(odd, allowed >> (tile_blocks / 2 + at / 2)));
  }
  // As the vector that begins at byte `at` of a tile.
  HWY_INLINE void store(std::size_t at, std::uint16_t* HWY_RESTRICT sums) const {
    const WordTag d;
    hn::StoreU(even, d, sums + at / 2);
    hn::StoreU(odd, d, sums + tile_blocks / 2 + at / 2);
  }
};

// A run of tiles for all points.
struct Run {
  const BoundPlanes& planes;
  const BoundPoints& points;
  int col;
  int row;
  int threshold;
  const std::uint64_t* allowed;
  std::int32_t* scratch;

  // No point's run of tiles begins beyond the planes.
  [[nodiscard]] bool is_inside() const {
    return col + points.least_col >= 0 && col + points.most_col <= planes.last_col &&
           row + points.least_row >= 0 && row + points.most_row <= planes.last_row;
  }
};

// The sums of `Vectors` (1, 2 or 4) neighbouring vectors stay in registers; up to eight points' bytes are
// added as bytes first.
template <int Vectors>
bool BoundVectors(const Run& run, bool inside, std::size_t first_byte, std::uint16_t* HWY_RESTRICT sums) {
  constexpr std::int32_t points_per_look = 32;
  constexpr std::int32_t points_per_byte = 255 / bound_levels;
  const BoundPoints& points = run.points;
  const ByteTag d;
  const std::size_t lanes = hn::Lanes(d);
  const auto zero = hn::Zero(WordTag());
  Sums sum0{zero, zero}, sum1{zero, zero}, sum2{zero, zero}, sum3{zero, zero};
  std::int64_t weight_left = 0;
  for (std::int32_t list = 0; list < points.lists; ++list)
    weight_left += std::int64_t{points.list_end[list] - points.list_begin[list]} << (points.lists - 1 - list);
  const std::ptrdiff_t run_byte = inside ? 4 * (std::ptrdiff_t{run.row} * run.planes.stride + run.col) : 0;
  const std::uint8_t* HWY_RESTRICT data =
      reinterpret_cast<const std::uint8_t*>(run.planes.column_of_4) + run_byte + first_byte;
  const auto largest_of = [&](const Sums& sum, std::size_t vector) HWY_ATTR {
    const std::size_t at = first_byte + vector * lanes;
    return sum.largest(run.allowed[at / tile_blocks], at % tile_blocks);
  };
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
    if (!inside) TileOffsets(run.planes, points, run.col, run.row, begin, end, run.scratch);
    const std::int32_t* HWY_RESTRICT offset = inside ? points.first_byte + begin : run.scratch;
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
      if (bound_levels * weight_left >= run.threshold) continue;
      auto largest = largest_of(sum0, 0);
      if constexpr (Vectors > 1) largest = hn::Max(largest, largest_of(sum1, 1));
      if constexpr (Vectors > 2) largest = hn::Max(largest, largest_of(sum2, 2));
      if constexpr (Vectors > 2) largest = hn::Max(largest, largest_of(sum3, 3));
      const std::int64_t most = std::int64_t{hn::GetLane(hn::MaxOfLanes(WordTag(), largest))} << bit;
      if (most + bound_levels * weight_left < run.threshold) return false;
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

std::uint16_t KeepAllowed(std::uint64_t allowed, std::uint16_t* HWY_RESTRICT sums) {
  const WordTag d;
  auto largest = hn::Zero(d);
  for (std::size_t i = 0; i < tile_blocks; i += hn::Lanes(d)) {
    const auto kept = KeepLanes(hn::LoadU(d, sums + i), allowed >> i);
    hn::StoreU(kept, d, sums + i);
    largest = hn::Max(largest, kept);
  }
  return hn::GetLane(hn::MaxOfLanes(d, largest));
}

void BoundTiles(const BoundPlanes& planes, const BoundPoints& points, int tile_col, int tile_row, int tiles,
                int threshold, const std::uint64_t* allowed, std::int32_t* scratch, std::uint16_t* sums,
                std::uint16_t* largest) {
  const std::size_t lanes = hn::Lanes(ByteTag());
  const std::size_t bytes = static_cast<std::size_t>(tiles) * tile_blocks;
  // The last vectors may reach past the run: their sums end here, and nothing is allowed there.
  HWY_ALIGN std::uint16_t run_sums[most_tiles * tile_blocks];
  std::uint64_t run_allowed[most_tiles] = {};
  std::copy_n(allowed, tiles, run_allowed);
  const Run run{.planes = planes,
                .points = points,
                .col = tile_col,
                .row = tile_row,
                .threshold = threshold,
                .allowed = run_allowed,
                .scratch = scratch};
  const bool inside = run.is_inside();
  for (int tile = 0; tile < tiles; ++tile) largest[tile] = 1;
  for (std::size_t at = 0; at < bytes;) {
    const std::size_t vectors_left = (bytes - at) / lanes;
    const std::size_t vectors = vectors_left >= 3 ? 4 : vectors_left;
    const bool bounded = vectors == 4   ? BoundVectors<4>(run, inside, at, run_sums)
                         : vectors == 2 ? BoundVectors<2>(run, inside, at, run_sums)
                                        : BoundVectors<1>(run, inside, at, run_sums);
    const std::size_t end = std::min(bytes, at + vectors * lanes);
    if (!bounded)
      for (std::size_t tile = at / tile_blocks; tile * tile_blocks < end; ++tile) largest[tile] = 0;
    at = end;
  }
  std::copy_n(run_sums, bytes, sums);
  for (int tile = 0; tile < tiles; ++tile)
    if (largest[tile] != 0) largest[tile] = KeepAllowed(allowed[tile], sums + tile * tile_blocks);
}

#endif

std::uint64_t LanesAtLeast(const std::uint16_t* sums, int least) {
  const hn::CappedTag<std::uint16_t, tile_blocks / 2> d;
  const auto bar = hn::Set(d, static_cast<std::uint16_t>(least));
  std::uint64_t bits = 0;
  for (std::size_t lane = 0; lane < tile_blocks; lane += hn::Lanes(d)) {
    std::uint8_t some[8] = {};
    const auto sum = hn::LoadU(d, sums + lane);
    hn::StoreMaskBits(d, hn::Eq(sum, hn::Max(sum, bar)), some);
    std::uint64_t word = 0;
    std::memcpy(&word, some, sizeof(word));
    bits |= word << lane;
  }
  return bits;
}

}  // namespace HWY_NAMESPACE
}  // namespace landfall::kernels
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace landfall::kernels {

namespace scalar {
std::uint64_t lanes_at_least(const std::uint16_t* sums, int least) {
  std::uint64_t bits = 0;
  for (int lane = 0; lane < tile_blocks; ++lane)
    if (sums[lane] >= least) bits |= std::uint64_t{1} << lane;
  return bits;
}

void bound_tiles(const BoundPlanes& planes, const BoundPoints& points, int tile_col, int tile_row, int tiles,
                 int /*threshold*/, const std::uint64_t* allowed, std::int32_t* /*scratch*/,
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
      const bool is_allowed = ((allowed[tile] >> lane) & 1U) != 0;
      sums[at] =
          is_allowed ? static_cast<std::uint16_t>(std::min<std::int64_t>(sum, 65535)) : std::uint16_t{0};
      largest[tile] = std::max(largest[tile], sums[at]);
    }
  }
}
}  // namespace scalar

HWY_EXPORT(BoundTiles);
HWY_EXPORT(LanesAtLeast);

void bound_tiles(const BoundPlanes& planes, const BoundPoints& points, int tile_col, int tile_row, int tiles,
                 int threshold, const std::uint64_t* allowed, std::int32_t* scratch, std::uint16_t* sums,
                 std::uint16_t* largest) {
  const auto bound = scalar_selected() ? scalar::bound_tiles : HWY_DYNAMIC_DISPATCH(BoundTiles);
  bound(planes, points, tile_col, tile_row, tiles, threshold, allowed, scratch, sums, largest);
}

std::uint64_t lanes_at_least(const std::uint16_t* sums, int least) {
  return scalar_selected() ? scalar::lanes_at_least(sums, least)
                           : HWY_DYNAMIC_DISPATCH(LanesAtLeast)(sums, least);
}

}  // namespace landfall::kernels
#endif
