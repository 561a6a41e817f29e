#include "engine/lattice_score.hpp"

namespace landfall::internal {
namespace {

std::int32_t field_score(const Query& query, const HeadingCells& cells, const LatticePose& pose) {
  const GridMap& grid = query.map.grid();
  const std::vector<std::uint8_t>& field = query.map.field();
  std::int32_t sum = 0;
  for (std::size_t i = 0; i < cells.col.size(); ++i) {
    const CellIndex cell{.col = pose.col + cells.col[i], .row = pose.row + cells.row[i]};
    if (grid.contains(cell)) sum += field[grid.index(cell)];
  }
  return sum;
}

}  // namespace

std::optional<Candidate> best_on_lattice_beside(const Query& query, const Pose2& T_map_robot) {
  const LatticePose nearest = query.lattice.nearest(T_map_robot);
  const int step = query.lattice.step_cells;
  const int headings = query.lattice.headings;
  std::optional<Candidate> best;
  HeadingCells cells;
  for (int turn = -1; turn <= 1; ++turn) {
    LatticePose pose{.heading = (nearest.heading + turn + headings) % headings};
    cells_at_heading(query.points, query.lattice, pose.heading, cells);
    for (pose.row = nearest.row - step; pose.row <= nearest.row + step; pose.row += step) {
      for (pose.col = nearest.col - step; pose.col <= nearest.col + step; pose.col += step) {
        if (!query.domain.contains(pose)) continue;
        const Candidate one{.pose = pose, .score = field_score(query, cells, pose)};
        if (!best || better(one, *best)) best = one;
      }
    }
  }
  return best;
}

}  // namespace landfall::internal
