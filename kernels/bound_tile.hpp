// Dense bounds: many neighbouring blocks of poses at a time, for a group of headings.
#pragma once

#include <cstddef>
#include <cstdint>

namespace landfall::kernels {

inline constexpr int tile_cols = 16;
inline constexpr int tile_rows = 4;
inline constexpr int tile_blocks = tile_cols * tile_rows;
// So many tiles, side by side, are bounded together.
inline constexpr int most_tiles = 4;
inline constexpr int run_cols = most_tiles * tile_cols;

// Values of the bound tables: 0 .. 31, so that eight of them still fit into a byte.
inline constexpr int bound_levels = 31;

// Planes of window maxima, one per window size and phase, each padded so that a clamped run of tiles reads
// zeros where it is off the map.
struct BoundPlanes {
  const std::uint32_t* column_of_4 = nullptr;  // [row][col]: four rows' levels from there upwards, one byte
                                               // each, the lowest row in the lowest byte
  std::int32_t stride = 0;                     // elements a row
  std::int32_t last_col = 0;  // a run begins in columns 0 .. last_col and rows 0 .. last_row, padding
  std::int32_t last_row = 0;  // included; the outermost runs are empty
};

// Points of one heading group, structure of arrays: the plane's first element, and the block offset
// (padding added). A point of weight w stands in the list of every bit of w; lists from the highest bit
// down, list b holds [list_begin[b], list_end[b]). A vector may be read from any point: the arrays are
// `point_padding` longer than their last list.
struct BoundPoints {
  const std::int32_t* plane = nullptr;
  const std::int32_t* col = nullptr;
  const std::int32_t* row = nullptr;
  const std::int32_t* first_byte =
      nullptr;  // 4 * (plane + row * stride + col): of the tile (0, 0), unclamped
  const std::int32_t* list_begin = nullptr;  // [lists]
  const std::int32_t* list_end = nullptr;    // [lists]
  std::int32_t lists = 0;
  std::int32_t least_col = 0, most_col = 0;  // of all points
  std::int32_t least_row = 0, most_row = 0;
};
inline constexpr int point_padding = 16;

// Where block (col, row) of a tile stands among its sums: even rows first, as the kernel adds them.
constexpr int tile_lane(int col, int row) {
  return (row & 1) * (tile_blocks / 2) + (col * tile_rows + row) / 2;
}
constexpr int lane_row(int lane) {
  return 2 * (lane % 2) + (lane >= tile_blocks / 2 ? 1 : 0);
}
constexpr int lane_col(int lane) {
  return lane % (tile_blocks / 2) / 2;
}

// `tiles` of them (1 .. most_tiles), each tile_cols farther right than the one before.
// sums[t * tile_blocks + tile_lane(c, r)]: the weighted sum over the points for block
// (tile_row + r, tile_col + t * tile_cols + c), saturated at 65535, where bit tile_lane(c, r) of allowed[t]
// is set, 0 elsewhere. largest[t]: the largest of a tile. A tile none of whose allowed blocks can reach
// `threshold` (at most 65535) may be given up: its sums are undefined then, and its largest is 0. `scratch`
// holds one element per point of the longest list, and point_padding.
void bound_tiles(const BoundPlanes& planes, const BoundPoints& points, int tile_col, int tile_row, int tiles,
                 int threshold, const std::uint64_t* allowed, std::int32_t* scratch, std::uint16_t* sums,
                 std::uint16_t* largest);

// Bit l: sums[l] >= least, of one tile. `least` 0 .. 65535.
std::uint64_t lanes_at_least(const std::uint16_t* sums, int least);

namespace scalar {
std::uint64_t lanes_at_least(const std::uint16_t* sums, int least);
void bound_tiles(const BoundPlanes& planes, const BoundPoints& points, int tile_col, int tile_row, int tiles,
                 int threshold, const std::uint64_t* allowed, std::int32_t* scratch, std::uint16_t* sums,
                 std::uint16_t* largest);
}  // namespace scalar

}  // namespace landfall::kernels
