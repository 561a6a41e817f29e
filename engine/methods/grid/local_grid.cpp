#include "engine/methods/grid/local_grid.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace landfall::internal {
namespace {

enum Mark : std::uint8_t { seen_through = 1, in_arc = 2, is_touched = 4 };

// Memory of a local grid ends here: 100 m in cells of 5 cm.
constexpr double farthest_local_cells = 2000.0;
constexpr double unsure_cells = 2.0;  // before a sector's end

}  // namespace

int LocalModel::reach_cells() const {
  double reach = robot_radius_cells;
  for (const Cone& cone : cones)
    reach = std::max(reach, std::hypot(cone.mount_x_cells, cone.mount_y_cells) + cone.range_cells + 1.0);
  return static_cast<int>(std::ceil(reach)) + 1;
}

std::int32_t LocalModel::arc_weight() const {
  constexpr std::int32_t finest = 1 << 14;
  constexpr std::int32_t most = 1 << 30;  // arcs, sectors and the robot together
  const auto arcs = static_cast<std::int32_t>(std::max<std::size_t>(1, 3 * cones.size()));
  return std::clamp(most / arcs, 1, finest);
}

LocalModel make_local_model(const Scan& scan, const Lattice& lattice, double robot_radius_m, int factor) {
  const double farthest =
      std::min(farthest_local_cells, std::hypot(lattice.width_cells, lattice.height_cells) + 1.0);
  LocalModel model{.cones = make_cones(scan, lattice.resolution_m, farthest),
                   .robot_radius_cells = std::min(farthest, robot_radius_m / lattice.resolution_m)};
  for (Cone& cone : model.cones) cone.behind_face_cells /= factor;
  return model;
}

LocalGridPainter::LocalGridPainter(const LocalModel& model)
    : model_(model),
      reach_(model.reach_cells()),
      side_(2 * reach_ + 1),
      arc_weight_(model.arc_weight()),
      parts_(model.cones.size()),
      weights_(static_cast<std::size_t>(side_) * static_cast<std::size_t>(side_)),
      last_cone_(weights_.size()),
      marks_(weights_.size()) {
  const auto radius = static_cast<int>(model.robot_radius_cells);
  for (int row = -radius; row <= radius; ++row)
    for (int col = -radius; col <= radius; ++col)
      if (std::hypot(col, row) <= model.robot_radius_cells) robot_.push_back({.col = col, .row = row});
}

// Where a cone's cells lie, each once; marks those that its sector is sure of.
void LocalGridPainter::trace(std::size_t cone, double heading_rad) {
  const Cone model = turned(model_.cones[cone], heading_rad);
  Part& part = parts_[cone];
  arc_cells(model, part.arc);
  sector_cells(model, part.sector);
  const auto stamp = static_cast<std::int32_t>(cone + 1);
  for (const CellIndex cell : part.arc) last_cone_[index(cell)] = stamp;
  const double sure_cells = model.range_cells - (model.echo ? unsure_cells : 0.0);
  const double sure_squared = sure_cells > 0.0 ? sure_cells * sure_cells : -1.0;
  std::size_t kept = 0;
  for (const CellIndex cell : part.sector) {
    const std::size_t i = index(cell);
    if (last_cone_[i] == stamp) continue;
    last_cone_[i] = stamp;
    part.sector[kept++] = cell;
    const double x = cell.col - model.mount_x_cells;
    const double y = cell.row - model.mount_y_cells;
    if (x * x + y * y < sure_squared) marks_[i] |= seen_through;
  }
  part.sector.resize(kept);
  for (const std::vector<CellIndex>* cells : {&part.arc, &part.sector}) {
    for (const CellIndex cell : *cells) {
      std::uint8_t& mark = marks_[index(cell)];
      if ((mark & is_touched) == 0) touched_.push_back(cell);
      mark |= is_touched;
    }
  }
}

void LocalGridPainter::settle_arc(std::vector<CellIndex>& arc) {
  const auto is_seen_through = [this](CellIndex cell) { return (marks_[index(cell)] & seen_through) != 0; };
  if (!std::all_of(arc.begin(), arc.end(), is_seen_through)) std::erase_if(arc, is_seen_through);
}

// Equal shares that sum up to the total exactly.
void LocalGridPainter::add(const std::vector<CellIndex>& cells, std::int32_t total) {
  if (cells.empty()) return;
  const auto count = static_cast<std::int32_t>(cells.size());
  const std::int32_t share = total / count;
  std::int32_t rest = total - share * count;
  const std::int32_t unit = rest < 0 ? -1 : 1;
  for (const CellIndex cell : cells) {
    const bool extra = rest != 0;
    weights_[index(cell)] += share + (extra ? unit : 0);
    if (extra) rest -= unit;
  }
}

void LocalGridPainter::paint_robot() {
  for (const CellIndex cell : robot_) {
    std::uint8_t& mark = marks_[index(cell)];
    if ((mark & is_touched) == 0) touched_.push_back(cell);
    mark |= is_touched;
  }
  add(robot_, -arc_weight_ * static_cast<std::int32_t>(model_.cones.size()));
}

void LocalGridPainter::collect(LocalGrid& grid) {
  grid.cells.clear();
  grid.weights.clear();
  for (const CellIndex cell : touched_) {
    const std::size_t i = index(cell);
    if (weights_[i] != 0) {
      grid.cells.push_back(cell);
      grid.weights.push_back(weights_[i]);
      grid.perfect_score += std::abs(weights_[i]);
    }
    weights_[i] = 0;
    last_cone_[i] = 0;
    marks_[i] = 0;
  }
  touched_.clear();
}

void LocalGridPainter::paint(double heading_rad, LocalGrid& grid) {
  grid.perfect_score = 0;
  for (std::size_t i = 0; i < parts_.size(); ++i) trace(i, heading_rad);
  for (Part& part : parts_) settle_arc(part.arc);
  for (const Part& part : parts_)
    for (const CellIndex cell : part.arc) marks_[index(cell)] |= in_arc;
  for (Part& part : parts_) {
    std::erase_if(part.sector, [this](CellIndex cell) { return (marks_[index(cell)] & in_arc) != 0; });
    add(part.arc, arc_weight_);
    add(part.sector, -arc_weight_);
  }
  paint_robot();
  collect(grid);
}

LocalGrid turned_raster(const LocalGrid& grid, double heading_rad) {
  const double c = std::cos(heading_rad);
  const double s = std::sin(heading_rad);
  std::map<std::pair<int, int>, std::int32_t> weight_at;  // by row, column
  for (std::size_t i = 0; i < grid.cells.size(); ++i) {
    const double x = c * grid.cells[i].col - s * grid.cells[i].row;
    const double y = s * grid.cells[i].col + c * grid.cells[i].row;
    weight_at[{static_cast<int>(std::lround(y)), static_cast<int>(std::lround(x))}] = grid.weights[i];
  }
  LocalGrid result;
  result.perfect_score = grid.perfect_score;
  for (const auto& [at, weight] : weight_at) {
    result.cells.push_back({.col = at.second, .row = at.first});
    result.weights.push_back(weight);
  }
  return result;
}

}  // namespace landfall::internal
