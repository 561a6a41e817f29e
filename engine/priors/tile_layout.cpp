#include "engine/priors/tile_layout.hpp"

#include <algorithm>

namespace landfall::internal {

using kernels::tile_blocks;
using kernels::tile_cols;
using kernels::tile_rows;

BlockSet blocks_of(std::span<const SharedMask> shared) {
  std::vector<const BlockMask*> masks;
  for (const SharedMask& mask : shared)
    if (mask != nullptr && !mask->words.empty() && (masks.empty() || masks.back() != mask.get()))
      masks.push_back(mask.get());
  BlockSet blocks;
  if (masks.empty()) return blocks;
  int last_col = masks.front()->first_col;
  int last_row = masks.front()->first_row;
  blocks.first_col = last_col;
  blocks.first_row = last_row;
  for (const BlockMask* mask : masks) {
    blocks.first_col = std::min(blocks.first_col, mask->first_col);
    blocks.first_row = std::min(blocks.first_row, mask->first_row);
    last_col = std::max(last_col, mask->first_col + mask->cols);
    last_row = std::max(last_row, mask->first_row + mask->rows);
  }
  blocks.cols = last_col - blocks.first_col;
  blocks.rows = last_row - blocks.first_row;
  blocks.used.resize(static_cast<std::size_t>(blocks.cols) * static_cast<std::size_t>(blocks.rows));
  for (const BlockMask* mask : masks) {
    const std::uint64_t* word = mask->words.data();
    for (int row = 0; row < mask->rows; ++row) {
      std::uint8_t* used =
          blocks.used.data() +
          static_cast<std::ptrdiff_t>(row + mask->first_row - blocks.first_row) * blocks.cols +
          (mask->first_col - blocks.first_col);
      for (int col = 0; col < mask->cols; ++col) used[col] |= *word++ != 0 ? 1 : 0;
    }
  }
  return blocks;
}

BlockSet doubled(const BlockSet& blocks) {
  const auto half = [](int value) { return value >> 1; };
  BlockSet large;
  large.first_col = half(blocks.first_col);
  large.first_row = half(blocks.first_row);
  if (blocks.used.empty()) return large;
  large.cols = half(blocks.first_col + blocks.cols - 1) - large.first_col + 1;
  large.rows = half(blocks.first_row + blocks.rows - 1) - large.first_row + 1;
  large.used.resize(static_cast<std::size_t>(large.cols) * static_cast<std::size_t>(large.rows));
  const std::uint8_t* from = blocks.used.data();
  for (int row = blocks.first_row; row < blocks.first_row + blocks.rows; ++row) {
    std::uint8_t* to =
        large.used.data() + static_cast<std::ptrdiff_t>(half(row) - large.first_row) * large.cols;
    for (int col = blocks.first_col; col < blocks.first_col + blocks.cols; ++col)
      to[half(col) - large.first_col] |= *from++;
  }
  return large;
}

TileLayout::TileLayout(const BlockSet& blocks, int alignment) {
  const auto aligned = [alignment](int value) { return value / alignment * alignment; };
  const int last_col = blocks.first_col + blocks.cols;
  for (int row = aligned(blocks.first_row); row < blocks.first_row + blocks.rows; row += tile_rows) {
    const auto is_used = [&](int col) {
      for (int r = row; r < row + tile_rows; ++r)
        if (blocks.contains(col, r)) return true;
      return false;
    };
    for (int col = blocks.first_col; col < last_col; ++col) {
      if (!is_used(col)) continue;
      const Tile tile{.col = aligned(col), .row = row};
      const bool goes_on = !tiles.empty() && tiles.back().row == row &&
                           tiles.back().col + tile_cols == tile.col &&
                           runs.back().tiles < kernels::most_tiles;
      if (goes_on)
        ++runs.back().tiles;
      else
        runs.push_back({.first = static_cast<std::uint32_t>(tiles.size()), .tiles = 1});
      tiles.push_back(tile);
      std::uint64_t used = 0;
      for (int lane = 0; lane < tile_blocks; ++lane)
        if (blocks.contains(tile.col + kernels::lane_col(lane), row + kernels::lane_row(lane)))
          used |= std::uint64_t{1} << lane;
      allowed.push_back(used);
      col = tile.col + tile_cols - 1;
    }
  }
}

namespace {

std::uint64_t lanes_of_part(int col, int row) {
  std::uint64_t lanes = 0;
  for (int r = row; r < row + 2; ++r)
    for (int c = col; c < col + 2; ++c) lanes |= std::uint64_t{1} << kernels::tile_lane(c, r);
  return lanes;
}

std::vector<SearchTiles::Parts> find_parts(const TileLayout& coarse, const TileLayout& fine) {
  int last_col = 0;
  int last_row = 0;
  for (const TileLayout::Tile& tile : fine.tiles) {
    last_col = std::max(last_col, (tile.col + tile_cols) / 2);
    last_row = std::max(last_row, (tile.row + tile_rows) / 2);
  }
  const auto cols = static_cast<std::size_t>(last_col);
  std::vector<std::int32_t> tile_of_block(cols * static_cast<std::size_t>(last_row), -1);
  for (std::size_t t = 0; t < fine.size(); ++t)
    for (int row = fine.tiles[t].row / 2; row < (fine.tiles[t].row + tile_rows) / 2; ++row)
      std::fill_n(tile_of_block.begin() + row * static_cast<std::ptrdiff_t>(cols) + fine.tiles[t].col / 2,
                  tile_cols / 2, static_cast<std::int32_t>(t));
  std::vector<SearchTiles::Parts> parts;
  parts.reserve(coarse.size() * tile_blocks);
  for (const TileLayout::Tile& tile : coarse.tiles)
    for (int lane = 0; lane < tile_blocks; ++lane) {
      const int col = tile.col + kernels::lane_col(lane);
      const int row = tile.row + kernels::lane_row(lane);
      const bool inside = col < last_col && row < last_row;
      const std::int32_t t =
          inside ? tile_of_block[static_cast<std::size_t>(row) * cols + static_cast<std::size_t>(col)] : -1;
      if (t < 0) {
        parts.push_back({});
        continue;
      }
      const TileLayout::Tile& of = fine.tiles[static_cast<std::size_t>(t)];
      parts.push_back({.tile = t, .lanes = lanes_of_part(2 * col - of.col, 2 * row - of.row)});
    }
  return parts;
}

}  // namespace

SearchTiles::SearchTiles(const BlockSet& blocks)
    : small(blocks, 2), large(doubled(blocks), 2), parts(find_parts(large, small)) {}

}  // namespace landfall::internal
