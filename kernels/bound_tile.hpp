// Dense bounds: many neighbouring blocks of poses at a time, for a group of headings.
#pragma once

#include <cstddef>
#include <cstdint>

namespace landfall::kernels {

inline constexpr int tile_cols = 32;
inline constexpr int tile_rows = 8;
inline constexpr int tile_blocks = tile_cols * tile_rows;

// Values of the bound tables: 0 .. 31, so that eight of them still fit into a byte.
inline constexpr int bound_levels = 31;

// Planes of window maxima, one per window size and phase, each padded so that a clamped tile reads
// zeros where it is off the map.
struct BoundPlanes {
  const std::uint8_t* data = nullptr;
  std::int32_t stride = 0;    // bytes a row
  std::int32_t last_col = 0;  // a tile begins in columns 0 .. last_col and rows 0 .. last_row, padding
  std::int32_t last_row = 0;  // included; the outermost tiles are empty
};

// Points of one heading group, structure of arrays: the plane's first byte, and the block offset
// (padding added). A point of weight w stands in the list of every bit of w; lists from the highest
// bit down, list b ends at list_end[b].
struct BoundPoints {
  const std::int32_t* plane = nullptr;
  const std::int32_t* col = nullptr;
  const std::int32_t* row = nullptr;
  const std::int32_t* list_end = nullptr;  // [lists]
  std::int32_t lists = 0;
};

// sums[r * tile_cols + c]: the weighted sum over the points for block (tile_row + r, tile_col + c),
// saturated at 65535. False, sums undefined, once no block can reach `threshold` (at most 65535).
// `scratch` holds one element per point of the longest list.
bool bound_tile(const BoundPlanes& planes, const BoundPoints& points, int tile_col, int tile_row,
                int threshold, std::int32_t* scratch, std::uint16_t* sums);

namespace scalar {
bool bound_tile(const BoundPlanes& planes, const BoundPoints& points, int tile_col, int tile_row,
                int threshold, std::int32_t* scratch, std::uint16_t* sums);
}

}  // namespace landfall::kernels
