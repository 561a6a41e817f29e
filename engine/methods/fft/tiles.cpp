#include "engine/methods/fft/tiles.hpp"

#include <algorithm>

#include "engine/methods/fft/cost_model.hpp"
#include "engine/methods/fft/fast_size.hpp"
#include "kernels/score_block.hpp"

namespace landfall::internal {

double CorrelationTiles::cost_ns() const {
  return (count() + 1) * transform_ns(fft_rows, fft_cols);
}

// An end point farther along an axis than the map is wide lies outside from everywhere.
CorrelationTiles whole_map(int width_cells, int height_cells, int reach_cells) {
  return {.width_cells = width_cells,
          .height_cells = height_cells,
          .reach_cells = reach_cells,
          .tile_width_cells = width_cells,
          .tile_height_cells = height_cells,
          .fft_cols = fast_size(width_cells + std::min(reach_cells, width_cells)),
          .fft_rows = fast_size(height_cells + std::min(reach_cells, height_cells))};
}

CorrelationTiles square_tiles(int width_cells, int height_cells, int reach_cells, int fft_cells) {
  const int side = (fft_cells - 2 * reach_cells) / kernels::block_cells * kernels::block_cells;
  return {.width_cells = width_cells,
          .height_cells = height_cells,
          .reach_cells = reach_cells,
          .tile_width_cells = side,
          .tile_height_cells = side,
          .fft_cols = fft_cells,
          .fft_rows = fft_cells};
}

CorrelationTiles choose_tiles(int width_cells, int height_cells, int reach_cells) {
  CorrelationTiles best = whole_map(width_cells, height_cells, reach_cells);
  for (const int fft_cells : {256, 512, 1024, 2048}) {
    if (fft_cells < 2 * reach_cells + kernels::block_cells) continue;
    const CorrelationTiles tiles = square_tiles(width_cells, height_cells, reach_cells, fft_cells);
    if (tiles.cost_ns() < best.cost_ns()) best = tiles;
  }
  return best;
}

int prepared_reach(int width_cells, int height_cells, int reach_cells) {
  const int side = std::max(width_cells, height_cells);
  for (const int parts : {8, 4, 2}) {
    const int reach = (side + parts - 1) / parts;
    if (reach_cells <= reach) return reach;
  }
  return side;
}

}  // namespace landfall::internal
