// Occupancy grids, and the only place that converts metres to cells.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "landfall/pose2.hpp"

namespace landfall {

enum class Occupancy : std::uint8_t { free = 0, occupied = 1, unknown = 2 };

struct CellIndex {
  int col = 0;  // along the grid's x
  int row = 0;  // along the grid's y
  friend bool operator==(const CellIndex&, const CellIndex&) = default;
};

// Cells row by row from the grid's lower-left corner (an image's row 0 is its top: the loader flips).
struct GridMap {
  int width_cells = 0;
  int height_cells = 0;
  double resolution_m = 0.0;
  Pose2 T_map_grid;  // lower-left corner of cell (0, 0), and the direction of the grid's axes
  std::vector<Occupancy> cells;

  [[nodiscard]] bool contains(CellIndex cell) const {
    return cell.col >= 0 && cell.col < width_cells && cell.row >= 0 && cell.row < height_cells;
  }
  [[nodiscard]] std::size_t index(CellIndex cell) const {
    return static_cast<std::size_t>(cell.row) * static_cast<std::size_t>(width_cells) +
           static_cast<std::size_t>(cell.col);
  }
  // Outside the grid: unknown.
  [[nodiscard]] Occupancy at(CellIndex cell) const {
    return contains(cell) ? cells[index(cell)] : Occupancy::unknown;
  }
  // The cell that holds a point of the map frame; it may lie outside the grid, by no more than
  // 2^30 cells.
  [[nodiscard]] CellIndex cell_of(const Point2& p_map) const;
  // The centre of a cell, in the map frame.
  [[nodiscard]] Point2 center_of(CellIndex cell) const;
  friend bool operator==(const GridMap&, const GridMap&) = default;
};

// The largest map taken: indices into every derived table then fit into 32 bits, and distances into 16.
inline constexpr std::int64_t max_map_cells = std::int64_t{1} << 30;
inline constexpr int max_map_side_cells = 65'000;

// Throws Error{invalid_argument or too_large}: empty or oversized grid, cells other than width x height, a
// resolution outside 1e-6 to 1e6, an origin that is not finite or beyond 8e12 cells, where numbers blur them.
void validate(const GridMap& map);

}  // namespace landfall
