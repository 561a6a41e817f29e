// A made-up floor whose rooms differ, as those of real buildings do and those of office.hpp do not: strips of
// rooms, each room with a width, depth, doors and furniture of its own. 5 cm.
#pragma once

#include <algorithm>

#include "engine/base/counter_rng.hpp"
#include "landfall/grid_map.hpp"

namespace landfall::bench {

class Floor {
 public:
  // side_cells: 12 at least, the thickness of its walls included.
  static GridMap draw(int side_cells) {
    Floor floor(side_cells);
    for (int strip = 0, left = 0; left < side_cells - 1; ++strip) {
      internal::CounterRng rng(2, static_cast<std::uint32_t>(strip));
      const int right = floor.next_wall(left, rng);
      for (int bottom = 0; bottom < side_cells - 1;) {
        const int top = floor.next_wall(bottom, rng);
        floor.draw_room({.col = left, .row = bottom}, {.col = right, .row = top}, rng);
        bottom = top;
      }
      left = right;
    }
    floor.draw_outer_walls();
    return floor.map_;
  }

 private:
  static constexpr int least_room_cells = 50;
  static constexpr int most_room_cells = 120;
  static constexpr int door_cells = 18;

  explicit Floor(int side_cells)
      : map_{.width_cells = side_cells,
             .height_cells = side_cells,
             .resolution_m = 0.05,
             .T_map_grid = {},
             .cells = std::vector<Occupancy>(
                 static_cast<std::size_t>(side_cells) * static_cast<std::size_t>(side_cells),
                 Occupancy::free)} {}

  static int between(internal::CounterRng& rng, int least, int most) {
    return least + static_cast<int>(rng.below(static_cast<std::uint32_t>(std::max(0, most - least) + 1)));
  }

  // No room is left over that would be narrower than the least.
  [[nodiscard]] int next_wall(int wall, internal::CounterRng& rng) const {
    const int next = wall + between(rng, least_room_cells, most_room_cells);
    return next + least_room_cells > map_.width_cells - 1 ? map_.width_cells - 1 : next;
  }

  // Cells [from, to], both included.
  void fill(CellIndex from, CellIndex to, Occupancy what) {
    for (int row = from.row; row <= to.row; ++row)
      for (int col = from.col; col <= to.col; ++col) map_.cells[map_.index({col, row})] = what;
  }

  // Its left and lower walls, with a door in each.
  void draw_room(CellIndex from, CellIndex to, internal::CounterRng& rng) {
    fill(from, {from.col, to.row}, Occupancy::occupied);
    fill(from, {to.col, from.row}, Occupancy::occupied);
    const int door_row = between(rng, from.row + 1, to.row - door_cells - 1);
    const int door_col = between(rng, from.col + 1, to.col - door_cells - 1);
    fill({from.col, door_row}, {from.col, std::min(door_row + door_cells, to.row - 1)}, Occupancy::free);
    fill({door_col, from.row}, {std::min(door_col + door_cells, to.col - 1), from.row}, Occupancy::free);
    for (int piece = between(rng, 2, 6); piece > 0; --piece) draw_furniture(from, to, rng);
  }

  void draw_furniture(CellIndex from, CellIndex to, internal::CounterRng& rng) {
    const int wide = std::min(between(rng, 2, 30), (to.col - from.col) / 3);
    const int deep = std::min(between(rng, 2, 30), (to.row - from.row) / 3);
    const int col = between(rng, from.col + 1, to.col - wide);
    const int row = between(rng, from.row + 1, to.row - deep);
    fill({col, row}, {col + wide - 1, row + deep - 1}, Occupancy::occupied);
  }

  void draw_outer_walls() {
    const int last = map_.width_cells - 1;
    fill({0, 0}, {last, 0}, Occupancy::occupied);
    fill({0, 0}, {0, last}, Occupancy::occupied);
    fill({0, last}, {last, last}, Occupancy::occupied);
    fill({last, 0}, {last, last}, Occupancy::occupied);
  }

  GridMap map_;
};

}  // namespace landfall::bench
