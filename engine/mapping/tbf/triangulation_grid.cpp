#include "engine/mapping/tbf/triangulation_grid.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "engine/mapping/sector_cells.hpp"
#include "raycast/grid_walk.hpp"

namespace landfall::internal {
namespace {

constexpr double arc_sigmas = 3.0;

// visit(index) for the cells of a line that lie on the grid.
template <class Visit>
void visit_line(const GridMap& grid, const Point2& from_map, const Point2& to_map, const Visit& visit) {
  const double x = (from_map.x_m - grid.T_map_grid.x_m) / grid.resolution_m;
  const double y = (from_map.y_m - grid.T_map_grid.y_m) / grid.resolution_m;
  const double dx = (to_map.x_m - from_map.x_m) / grid.resolution_m;
  const double dy = (to_map.y_m - from_map.y_m) / grid.resolution_m;
  for (raycast::CellWalk walk(x, y, dx, dy); walk.entered() <= 1.0; walk.step()) {
    const CellIndex cell{.col = walk.col(), .row = walk.row()};
    if (grid.contains(cell)) visit(grid.index(cell));
  }
}

}  // namespace

TriangulationGrid::TriangulationGrid(GridMap grid, const TbfOptions& options)
    : grid_(std::move(grid)),
      options_(options),
      values_(grid_.cells.size(), 0.0f),
      on_line_(grid_.cells.size(), 0),
      cleared_(grid_.cells.size(), 0),
      ellipse_of_(grid_.cells.size(), 0) {}

void TriangulationGrid::add(const Triangulation& point, const SonarReading& reading) {
  if (!(std::sqrt(spectral_radius(point.covariance_m2())) < options_.max_deviation_m)) return;
  ++point_number_;
  raise_ellipse(point);
  halve_line(point.p_map(), reading.arc.center_map);
  clear_cone(reading);
}

// g = max(g, A |n_t| f) over E; A keeps g within 0 and 1, and what passes 1 is cut.
void TriangulationGrid::raise_ellipse(const Triangulation& point) {
  ellipse_cells(grid_, point.p_map(), point.covariance_m2(), ellipse_);
  const double scale = options_.scale_m2 * point.triangulations();
  for (const CellDensity& cell : ellipse_) {
    const auto value = static_cast<float>(std::min(1.0, scale * cell.density));
    values_[cell.index] = std::max(values_[cell.index], value);
    ellipse_of_[cell.index] = point_number_;
  }
}

// g = g / 2 over L without E.
void TriangulationGrid::halve_line(const Point2& from_map, const Point2& to_map) {
  visit_line(grid_, from_map, to_map, [&](std::size_t index) {
    if (ellipse_of_[index] == point_number_) return;
    values_[index] *= 0.5f;
    on_line_[index] = 1;
  });
}

void TriangulationGrid::clear_cone(const SonarReading& reading) {
  const double range_m = reading.arc.radius_m - arc_sigmas * reading.range_sigma_m - grid_.resolution_m;
  const double cos_inner = std::cos(0.5 * reading.arc.half_angle_rad);
  visit_sector(grid_, reading.arc, range_m, cos_inner,
               [&](std::size_t index, double, double) { cleared_[index] = 1; });
}

void TriangulationGrid::add_robot(const Pose2& T_map_robot, double radius_m) {
  const Arc circle = make_arc(T_map_robot, 0.0, radius_m);
  constexpr double cos_all = -1.0;
  visit_sector(grid_, circle, radius_m, cos_all,
               [&](std::size_t index, double, double) { cleared_[index] = 1; });
}

GridMap TriangulationGrid::to_map() const {
  GridMap map = grid_;
  for (std::size_t i = 0; i < values_.size(); ++i)
    map.cells[i] = values_[i] >= static_cast<float>(options_.occupied_value) ? Occupancy::occupied
                   : (on_line_[i] | cleared_[i]) != 0                        ? Occupancy::free
                                                                             : Occupancy::unknown;
  return map;
}

}  // namespace landfall::internal
