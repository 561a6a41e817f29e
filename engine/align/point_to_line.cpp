#include "engine/align/point_to_line.hpp"

#include <cmath>

#include "engine/align/residual_sum.hpp"

namespace landfall::internal {
namespace {

constexpr double least_facing = 0.7;  // cosine between the normals

}  // namespace

PairNormal point_to_line(const ScanView& fixed, const ScanView& moving, const Pose2& T_fixed_moving,
                         double gate_m) {
  PairNormal normal;
  ResidualSum sum(normal);
  const double c = std::cos(T_fixed_moving.theta_rad);
  const double s = std::sin(T_fixed_moving.theta_rad);
  for (const SurfacePoint& point : moving.points()) {
    const Point2 p{.x_m = T_fixed_moving.x_m + c * point.p.x_m - s * point.p.y_m,
                   .y_m = T_fixed_moving.y_m + s * point.p.x_m + c * point.p.y_m};
    const std::ptrdiff_t cell = fixed.index_of(p.x_m, p.y_m);
    const SurfacePoint* surface = cell < 0 ? nullptr : fixed.nearest(cell);
    if (surface == nullptr) continue;
    const double dx = p.x_m - surface->p.x_m;
    const double dy = p.y_m - surface->p.y_m;
    const double squared = dx * dx + dy * dy;
    if (squared > gate_m * gate_m) continue;
    if (!surface->has_normal) {
      if (point.has_normal) continue;
      sum.add(1.0, 0.0, p, dx, std::sqrt(squared));
      sum.add(0.0, 1.0, p, dy, std::sqrt(squared));
      continue;
    }
    const Point2& n = surface->normal;
    const double n_x = c * point.normal.x_m - s * point.normal.y_m;
    const double n_y = s * point.normal.x_m + c * point.normal.y_m;
    if (point.has_normal && n_x * n.x_m + n_y * n.y_m < least_facing) continue;
    const double residual_m = n.x_m * dx + n.y_m * dy;
    sum.add(n.x_m, n.y_m, p, residual_m, residual_m);
  }
  normal.hessian.triangularView<Eigen::StrictlyUpper>() = normal.hessian.transpose();
  return normal;
}

}  // namespace landfall::internal
