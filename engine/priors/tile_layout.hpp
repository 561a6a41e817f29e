// Which blocks of a map may hold a pose, and the tiles that cover them.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/priors/block_mask.hpp"
#include "kernels/bound_tile.hpp"

namespace landfall::internal {

// Blocks (col, row) with a pose of the prior at any heading.
struct BlockSet {
  int first_col = 0;
  int first_row = 0;
  int cols = 0;
  int rows = 0;
  std::vector<std::uint8_t> used;  // row by row

  [[nodiscard]] bool contains(int col, int row) const {
    const int c = col - first_col;
    const int r = row - first_row;
    return c >= 0 && r >= 0 && c < cols && r < rows &&
           used[static_cast<std::size_t>(r) * static_cast<std::size_t>(cols) + static_cast<std::size_t>(c)] !=
               0;
  }
};
// Blocks of kernels::block_cells. Null masks hold none.
BlockSet blocks_of(std::span<const SharedMask> masks);
// Blocks twice as large.
BlockSet doubled(const BlockSet& blocks);

// Rows of tiles, each begun at the next used block, or the one before: at multiples of `alignment`; of 2
// where the four parts of a block twice as large shall share a tile.
struct TileLayout {
  struct Tile {
    int col;  // block
    int row;
  };
  std::vector<Tile> tiles;
  std::vector<std::uint64_t> allowed;  // [tile]: bit kernels::tile_lane of every used block

  // Tiles [first, first + tiles) stand side by side; at most kernels::most_tiles.
  struct Run {
    std::uint32_t first;
    std::int32_t tiles;
  };
  std::vector<Run> runs;  // all tiles, in order

  explicit TileLayout(const BlockSet& blocks, int alignment = 1);
  [[nodiscard]] std::size_t size() const { return tiles.size(); }
  [[nodiscard]] std::size_t memory_bytes() const {
    return sizeof(Tile) * tiles.capacity() + sizeof(std::uint64_t) * allowed.capacity() +
           sizeof(Run) * runs.capacity();
  }
};

// Both levels of the dense bounds.
struct SearchTiles {
  TileLayout small;  // of the blocks given
  TileLayout large;  // of blocks twice as large
  // Per tile and lane of `large` where its four parts are in `small`; no lanes: nowhere.
  struct Parts {
    std::int32_t tile = 0;
    std::uint64_t lanes = 0;
  };
  std::vector<Parts> parts;

  explicit SearchTiles(const BlockSet& blocks);
  [[nodiscard]] std::size_t memory_bytes() const {
    return small.memory_bytes() + large.memory_bytes() + sizeof(Parts) * parts.capacity();
  }
};

}  // namespace landfall::internal
