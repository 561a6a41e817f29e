// Local occupancy grids: what a scan says of the cells around the robot, at one heading.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/methods/grid/cone.hpp"
#include "engine/priors/lattice.hpp"

namespace landfall::internal {

// The cells that are not unexplored, as offsets from the robot's.
struct LocalGrid {
  std::vector<CellIndex> cells{};
  std::vector<std::int32_t> weights{};  // > 0: occupied, < 0: free
  std::int64_t perfect_score = 0;       // where every cell falls on one of its own kind
};

// Cones and the robot's disc; cells of the robot weigh minus one arc for every cone, all together.
struct LocalModel {
  std::vector<Cone> cones;
  double robot_radius_cells = 0.0;

  [[nodiscard]] int reach_cells() const;  // no cell of any heading lies farther off, in either axis
  // What the cells of an arc weigh together, the paper's 1; so much that shares are fine, so little that
  // scores stay within 30 bits.
  [[nodiscard]] std::int32_t arc_weight() const;
};

// The lattice's cells are `factor` times as large as the map's, which an arc lies behind the face in.
LocalModel make_local_model(const Scan& scan, const Lattice& lattice, double robot_radius_m, int factor = 1);

// Draws local grids of a model. Keeps its memory from one heading to the next: one per thread.
//
// Cones that overlap: where one beam's sector covers a cell of another's arc, that one saw through it, so
// that the echo came from elsewhere on the arc: the cell leaves the arc, whose other cells share its weight.
// Not so within two cells of the sector's own end, where a range's error decides; and an arc that would lose
// all its cells keeps them: two readings then contradict each other, and the nearer one is believed, as a
// beam can miss what stands in its cone, but not hear what is not there. Cells of an arc are never a
// sector's. So each arc sums up to arc_weight(), and each sector that has a cell to -arc_weight().
class LocalGridPainter {
 public:
  explicit LocalGridPainter(const LocalModel& model);

  // Equation (3): the oriented local grid.
  void paint(double heading_rad, LocalGrid& grid);

 private:
  struct Part {
    std::vector<CellIndex> arc;
    std::vector<CellIndex> sector;
  };

  [[nodiscard]] std::size_t index(CellIndex cell) const {
    return static_cast<std::size_t>(cell.row + reach_) * static_cast<std::size_t>(side_) +
           static_cast<std::size_t>(cell.col + reach_);
  }
  void add(const std::vector<CellIndex>& cells, std::int32_t total);
  void trace(std::size_t cone, double heading_rad);
  void settle_arc(std::vector<CellIndex>& arc);
  void paint_robot();
  void collect(LocalGrid& grid);

  const LocalModel& model_;
  int reach_;
  int side_;
  std::int32_t arc_weight_;
  std::vector<Part> parts_;
  std::vector<std::int32_t> weights_;    // of the square around the robot
  std::vector<std::int32_t> last_cone_;  // that covered the cell with its sector, from 1
  std::vector<std::uint8_t> marks_;      // see Mark
  std::vector<CellIndex> touched_;
  std::vector<CellIndex> robot_;
};

// The raster turned, for comparison (section 3, figure 5): each cell goes where its centre is turned to. Of
// two cells that fall on one, the later stays.
LocalGrid turned_raster(const LocalGrid& grid, double heading_rad);

}  // namespace landfall::internal
