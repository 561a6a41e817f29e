#include "engine/methods/grid/cone.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>

namespace landfall::internal {
namespace {

CellIndex cell_at(double x_cells, double y_cells) {
  return {.col = static_cast<int>(std::floor(x_cells + 0.5)),
          .row = static_cast<int>(std::floor(y_cells + 0.5))};
}

bool touch(CellIndex a, CellIndex b) {
  return std::abs(a.col - b.col) <= 1 && std::abs(a.row - b.row) <= 1;
}

// Appends to an 8-connected path; a corner that its neighbours bypass is cut off.
void extend(std::vector<CellIndex>& path, CellIndex cell) {
  if (!path.empty() && path.back() == cell) return;
  while (path.size() >= 2 && touch(path[path.size() - 2], cell)) path.pop_back();
  if (path.empty() || path.back() != cell) path.push_back(cell);
}

// x of the points at height y that lie in the half plane left of (sign 1) or right of (-1) a direction.
void cut_by_edge(double edge_x, double edge_y, double sign, double y, double& low, double& high) {
  const double slope = sign * edge_y;
  const double level = sign * edge_x * y;
  if (slope > 0.0)
    high = std::min(high, level / slope);
  else if (slope < 0.0)
    low = std::max(low, level / slope);
  else if (level < 0.0)
    high = low - 1.0;
}

struct Wedge {
  double first_rad;
  double last_rad;  // less than half a turn later
};

// Row by row, the cells whose centre lies in the wedge.
void wedge_cells(const Cone& cone, const Wedge& wedge, std::vector<CellIndex>& cells) {
  const double first_x = std::cos(wedge.first_rad);
  const double first_y = std::sin(wedge.first_rad);
  const double last_x = std::cos(wedge.last_rad);
  const double last_y = std::sin(wedge.last_rad);
  const auto reaches = [&](double direction_rad) {
    const double turns = (direction_rad - wedge.first_rad) / (2.0 * std::numbers::pi);
    return (turns - std::floor(turns)) * 2.0 * std::numbers::pi <= wedge.last_rad - wedge.first_rad;
  };
  const double range = cone.range_cells;
  const double top = reaches(0.5 * std::numbers::pi) ? range : range * std::max({0.0, first_y, last_y});
  const double bottom = reaches(-0.5 * std::numbers::pi) ? -range : range * std::min({0.0, first_y, last_y});
  const auto last_row = static_cast<int>(std::floor(cone.mount_y_cells + top));
  for (auto row = static_cast<int>(std::ceil(cone.mount_y_cells + bottom)); row <= last_row; ++row) {
    const double y = row - cone.mount_y_cells;
    double high = std::sqrt(std::max(0.0, range * range - y * y));
    double low = -high;
    cut_by_edge(first_x, first_y, 1.0, y, low, high);
    cut_by_edge(last_x, last_y, -1.0, y, low, high);
    const auto last_col = static_cast<int>(std::floor(cone.mount_x_cells + high));
    for (auto col = static_cast<int>(std::ceil(cone.mount_x_cells + low)); col <= last_col; ++col)
      cells.push_back({.col = col, .row = row});
  }
}

// The axis up to the face: near the mount a cone is narrower than a cell.
void axis_cells(const Cone& cone, std::vector<CellIndex>& cells) {
  const double before_face = cone.range_cells - (cone.echo ? 0.5 : 0.0);
  if (before_face < 0.0) return;
  const double x = std::cos(cone.axis_rad);
  const double y = std::sin(cone.axis_rad);
  const int steps = static_cast<int>(std::ceil(before_face * std::max(std::abs(x), std::abs(y))));
  for (int i = 0; i <= steps; ++i) {
    const double distance = steps == 0 ? 0.0 : before_face * i / steps;
    cells.push_back(cell_at(cone.mount_x_cells + distance * x, cone.mount_y_cells + distance * y));
  }
}

}  // namespace

std::vector<Cone> make_cones(const Scan& scan, double resolution_m, double farthest_cells) {
  std::vector<Cone> cones;
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    const Beam& beam = scan.sensor->beams[i];
    const Reading reading = classify(beam, scan.ranges_m[i]);
    const Pose2& mount = beam.T_robot_beam;
    Cone cone{.mount_x_cells = mount.x_m / resolution_m,
              .mount_y_cells = mount.y_m / resolution_m,
              .axis_rad = mount.theta_rad,
              .half_angle_rad = beam.half_angle_rad,
              .range_cells = std::min<double>(scan.ranges_m[i], beam.range_max_m) / resolution_m,
              .echo = reading == Reading::echo};
    const double free_cells = farthest_cells - std::hypot(cone.mount_x_cells, cone.mount_y_cells);
    if (reading == Reading::invalid || free_cells <= 0.0) continue;
    if (cone.echo && cone.range_cells > free_cells) continue;
    cone.range_cells = std::min(cone.range_cells, free_cells);
    cones.push_back(cone);
  }
  return cones;
}

Cone turned(const Cone& cone, double heading_rad) {
  const double c = std::cos(heading_rad);
  const double s = std::sin(heading_rad);
  Cone result = cone;
  result.mount_x_cells = c * cone.mount_x_cells - s * cone.mount_y_cells;
  result.mount_y_cells = s * cone.mount_x_cells + c * cone.mount_y_cells;
  result.axis_rad = cone.axis_rad + heading_rad;
  return result;
}

void arc_cells(const Cone& cone, std::vector<CellIndex>& cells) {
  constexpr double spacing_cells = 0.2;
  cells.clear();
  if (!cone.echo) return;
  const double radius = cone.range_cells + cone.behind_face_cells;
  const int steps = static_cast<int>(std::ceil(2.0 * cone.half_angle_rad * radius / spacing_cells));
  const double first_rad = cone.axis_rad - cone.half_angle_rad;
  const double step_rad = steps == 0 ? 0.0 : 2.0 * cone.half_angle_rad / steps;
  double x = radius * std::cos(first_rad);
  double y = radius * std::sin(first_rad);
  const double c = std::cos(step_rad);
  const double s = std::sin(step_rad);
  for (int i = 0; i <= steps; ++i) {
    extend(cells, cell_at(cone.mount_x_cells + x, cone.mount_y_cells + y));
    const double next_x = c * x - s * y;
    y = s * x + c * y;
    x = next_x;
  }
  // A circle that all but closes.
  while (cells.size() > 2 && cone.half_angle_rad > 0.5 * std::numbers::pi && cells.back() == cells.front())
    cells.pop_back();
}

void sector_cells(const Cone& cone, std::vector<CellIndex>& cells) {
  constexpr double widest_rad = std::numbers::pi / 1.5;  // of a convex part
  cells.clear();
  axis_cells(cone, cells);
  if (cone.half_angle_rad <= 0.0) return;
  const int parts = static_cast<int>(std::ceil(2.0 * cone.half_angle_rad / widest_rad));
  const double part_rad = 2.0 * cone.half_angle_rad / parts;
  const double first_rad = cone.axis_rad - cone.half_angle_rad;
  for (int i = 0; i < parts; ++i)
    wedge_cells(cone, {.first_rad = first_rad + i * part_rad, .last_rad = first_rad + (i + 1) * part_rad},
                cells);
}

}  // namespace landfall::internal
