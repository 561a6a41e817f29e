#include "engine/scans/end_points.hpp"

#include <cmath>
#include <numeric>

#include "kernels/end_points.hpp"

namespace landfall::internal {
namespace {

// A stride near n / golden ratio that is coprime to n visits all of 0..n-1, neighbours far apart.
std::size_t scattering_stride(std::size_t count) {
  auto stride = static_cast<std::size_t>(static_cast<double>(count) * 0.6180339887);
  if (stride == 0) stride = 1;
  while (std::gcd(stride, count) != 1) ++stride;
  return stride;
}

}  // namespace

EndPoints make_end_points(const Scan& scan, double resolution_m) {
  EndPoints points;
  points.x_cells_by_beam.reserve(scan.ranges_m.size());
  points.y_cells_by_beam.reserve(scan.ranges_m.size());
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    const Beam& beam = scan.sensor->beams[i];
    if (classify(beam, scan.ranges_m[i]) != Reading::echo) continue;
    const Point2 p_robot = beam.T_robot_beam * Point2{scan.ranges_m[i], 0.0};
    const double x = p_robot.x_m / resolution_m;
    const double y = p_robot.y_m / resolution_m;
    if (std::abs(x) > farthest_cells || std::abs(y) > farthest_cells) continue;
    points.x_cells_by_beam.push_back(x);
    points.y_cells_by_beam.push_back(y);
  }
  const std::size_t count = points.x_cells_by_beam.size();
  if (count == 0) return points;
  points.x_cells.reserve(count);
  points.y_cells.reserve(count);
  const std::size_t stride = scattering_stride(count);
  for (std::size_t i = 0, at = 0; i < count; ++i, at = (at + stride) % count) {
    points.x_cells.push_back(points.x_cells_by_beam[at]);
    points.y_cells.push_back(points.y_cells_by_beam[at]);
  }
  return points;
}

void cells_at_heading(const EndPoints& points, const Lattice& lattice, int heading, HeadingCells& cells) {
  cells.col.resize(points.size());
  cells.row.resize(points.size());
  cells_at_heading(points, lattice, heading, cells.col.data(), cells.row.data());
}

void cells_at_heading(const EndPoints& points, const Lattice& lattice, int heading, std::int32_t* col,
                      std::int32_t* row) {
  const double heading_rad = lattice.heading_grid_rad(heading);
  kernels::end_point_cells(points.x_cells.data(), points.y_cells.data(), points.size(), std::cos(heading_rad),
                           std::sin(heading_rad), col, row);
}

}  // namespace landfall::internal
