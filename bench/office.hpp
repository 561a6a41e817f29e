// A made-up floor for where there are no real data: 30 x 30 m at 5 cm, rooms of 3 m with doors of 1 m, each
// with furniture of its own. Of another number of rooms where growth is measured.
#pragma once

#include "engine/base/counter_rng.hpp"
#include "landfall/grid_map.hpp"

namespace landfall::bench {

inline void draw_furniture(GridMap& map, int room_col, int room_row, int room_cells) {
  internal::CounterRng rng(1, static_cast<std::uint32_t>(room_col), static_cast<std::uint32_t>(room_row));
  for (int piece = 0; piece < 3; ++piece) {
    const auto cells = [&rng](int least, int most) {
      return least + static_cast<int>(rng.below(static_cast<std::uint32_t>(most - least + 1)));
    };
    const int wide = cells(3, 14);
    const int deep = cells(3, 14);
    const int first_col = room_col * room_cells + cells(1, room_cells - wide);
    const int first_row = room_row * room_cells + cells(1, room_cells - deep);
    for (int row = first_row; row < first_row + deep; ++row)
      for (int col = first_col; col < first_col + wide; ++col)
        map.cells[map.index({.col = col, .row = row})] = Occupancy::occupied;
  }
}

inline GridMap office(int rooms = 10) {
  constexpr int room_cells = 60;
  constexpr int door_cells = 20;
  const int side = rooms * room_cells + 1;
  GridMap map{.width_cells = side,
              .height_cells = side,
              .resolution_m = 0.05,
              .T_map_grid = {},
              .cells = std::vector<Occupancy>(static_cast<std::size_t>(side) * static_cast<std::size_t>(side),
                                              Occupancy::free)};
  for (int row = 0; row < side; ++row)
    for (int col = 0; col < side; ++col) {
      const bool outer = row % (side - 1) == 0 || col % (side - 1) == 0;
      const bool wall = (row % room_cells == 0 && col % room_cells >= door_cells) ||
                        (col % room_cells == 0 && row % room_cells >= door_cells);
      if (outer || wall) map.cells[map.index({.col = col, .row = row})] = Occupancy::occupied;
    }
  for (int row = 0; row < rooms; ++row)
    for (int col = 0; col < rooms; ++col) draw_furniture(map, col, row, room_cells);
  return map;
}

}  // namespace landfall::bench
