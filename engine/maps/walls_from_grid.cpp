// Cells become the faces between them.
#include <vector>

#include "landfall/wall_map.hpp"

namespace landfall {
namespace {

// Collects the faces along one family of grid lines; lines advance together, one cell at a time, so that
// the grid is read row by row for both families.
class FaceRuns {
 public:
  explicit FaceRuns(int lines) : start_(static_cast<std::size_t>(lines), no_run) {}

  // The face of `line` between positions `at` and `at` + 1 is there or not. emit(line, first, last) is
  // called for each run of neighbouring faces when it ends.
  template <typename Emit>
  void face(int line, int at, bool present, Emit emit) {
    int& start = start_[static_cast<std::size_t>(line)];
    if (present && start == no_run) start = at;
    if (!present && start != no_run) {
      emit(line, start, at);
      start = no_run;
    }
  }

 private:
  static constexpr int no_run = -1;
  std::vector<int> start_;
};

bool occupied(const GridMap& map, int col, int row) {
  return map.at({.col = col, .row = row}) == Occupancy::occupied;
}

}  // namespace

WallMap to_walls(const GridMap& map) {
  validate(map);
  WallMap walls;
  const auto corner = [&](int col, int row) {
    return map.T_map_grid * Point2{.x_m = col * map.resolution_m, .y_m = row * map.resolution_m};
  };
  const auto along_row = [&](int row, int first_col, int last_col) {
    walls.walls.push_back({.a_map = corner(first_col, row), .b_map = corner(last_col, row)});
  };
  const auto along_col = [&](int col, int first_row, int last_row) {
    walls.walls.push_back({.a_map = corner(col, first_row), .b_map = corner(col, last_row)});
  };
  FaceRuns rows(map.height_cells + 1);
  FaceRuns cols(map.width_cells + 1);
  // One row and column beyond the grid: faces at its border, and the end of every run.
  for (int row = 0; row <= map.height_cells; ++row)
    for (int col = 0; col <= map.width_cells; ++col) {
      const bool here = occupied(map, col, row);
      rows.face(row, col, here != occupied(map, col, row - 1), along_row);
      cols.face(col, row, here != occupied(map, col - 1, row), along_col);
    }
  return walls;
}

}  // namespace landfall
