// How a map is cut for transforms: whole, or in tiles that overlap (overlap-save).
#pragma once

namespace landfall::internal {

// Tiles of poses, counted row by row, each beginning at a multiple of a block; the transform of each also
// sees the cells within reach_cells of its poses, so that nothing wraps around.
struct CorrelationTiles {
  int width_cells = 0;  // of the map
  int height_cells = 0;
  int reach_cells = 0;  // end points are no farther from the robot's cell, along either axis
  int tile_width_cells = 0;
  int tile_height_cells = 0;
  int fft_cols = 0;
  int fft_rows = 0;

  [[nodiscard]] int across() const { return (width_cells + tile_width_cells - 1) / tile_width_cells; }
  [[nodiscard]] int up() const { return (height_cells + tile_height_cells - 1) / tile_height_cells; }
  [[nodiscard]] int count() const { return across() * up(); }
  [[nodiscard]] int first_col(int tile) const { return tile % across() * tile_width_cells; }
  [[nodiscard]] int first_row(int tile) const { return tile / across() * tile_height_cells; }
  // Of one heading, in the units of cost_model.hpp: all tiles' inverse transforms and the scan's own.
  [[nodiscard]] double cost_ns() const;
};

// The map as one tile. Cells outside hold 0, so that padding on one side serves both.
CorrelationTiles whole_map(int width_cells, int height_cells, int reach_cells);
// Square transforms of this size; it must exceed twice the reach by a block.
CorrelationTiles square_tiles(int width_cells, int height_cells, int reach_cells, int fft_cells);
// What costs the least.
CorrelationTiles choose_tiles(int width_cells, int height_cells, int reach_cells);

// The reach that spectra are prepared for: a half, a quarter or an eighth of the map's longer side where that
// suffices, so that scans of all ranges share a few spectra.
int prepared_reach(int width_cells, int height_cells, int reach_cells);

}  // namespace landfall::internal
