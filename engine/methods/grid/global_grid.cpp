#include "engine/methods/grid/global_grid.hpp"

#include <array>

namespace landfall::internal {
namespace {

bool is_inside(const GridMap& map, CellIndex cell) {
  const std::array<CellIndex, 4> neighbours{{{.col = cell.col - 1, .row = cell.row},
                                             {.col = cell.col + 1, .row = cell.row},
                                             {.col = cell.col, .row = cell.row - 1},
                                             {.col = cell.col, .row = cell.row + 1}}};
  for (const CellIndex neighbour : neighbours)
    if (map.at(neighbour) != Occupancy::occupied) return false;
  return true;
}

}  // namespace

std::vector<std::int8_t> global_grid(const GridMap& map, Contours contours) {
  std::vector<std::int8_t> cells;
  cells.reserve(map.cells.size());
  for (int row = 0; row < map.height_cells; ++row) {
    for (int col = 0; col < map.width_cells; ++col) {
      const Occupancy cell = map.cells[map.index({col, row})];
      std::int8_t value = cell == Occupancy::free ? std::int8_t{-1} : std::int8_t{0};
      if (cell == Occupancy::occupied &&
          (contours == Contours::uncorrected || !is_inside(map, {.col = col, .row = row})))
        value = 1;
      cells.push_back(value);
    }
  }
  return cells;
}

}  // namespace landfall::internal
