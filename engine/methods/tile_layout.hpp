// Which blocks of a map may hold a pose, and the tiles that cover them.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/domain.hpp"
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
// Blocks of kernels::block_cells.
BlockSet blocks_of(const Domain& domain);
// Blocks twice as large.
BlockSet doubled(const BlockSet& blocks);

// Rows of tiles, each begun at the next used block, or the one before: at even columns and rows, so that the
// four parts of a block twice as large share a tile.
struct TileLayout {
  struct Tile {
    int col;  // block
    int row;
  };
  std::vector<Tile> tiles;
  std::vector<std::uint16_t> allowed;  // [tile][lane]: all ones where the block is used

  // Tiles [first, first + tiles) stand side by side; at most kernels::most_tiles.
  struct Run {
    std::uint32_t first;
    std::int32_t tiles;
  };
  std::vector<Run> runs;  // all tiles, in order

  explicit TileLayout(const BlockSet& blocks);
  [[nodiscard]] std::size_t size() const { return tiles.size(); }
};

// Per lane of `coarse` the tile of `fine` that holds its four parts; -1: none.
std::vector<std::int32_t> tile_of_lanes(const TileLayout& coarse, const TileLayout& fine);

}  // namespace landfall::internal
