#include "engine/align/point_to_line.hpp"

#include <cmath>

namespace landfall::internal {
namespace {

constexpr double outlier_m = 0.05;    // scale of the weights
constexpr double least_facing = 0.7;  // cosine between the normals
// One sigma of a residual. Neighbouring points share their faults, so that this is worse than a point's own.
constexpr double sigma_m = 0.04;

class Sum {
 public:
  explicit Sum(PairNormal& normal) : normal_(normal) {}

  // One residual along (n_x, n_y) at p. `off_m`: what its weight goes by.
  void add(double n_x, double n_y, const Point2& p, double residual_m, double off_m) {
    const double ratio = 1.0 + off_m * off_m / (outlier_m * outlier_m);
    const double weight = 1.0 / (sigma_m * sigma_m * ratio * ratio);
    const double n_theta = n_y * p.x_m - n_x * p.y_m;
    const double j[3] = {n_x, n_y, n_theta};
    for (int row = 0; row < 3; ++row) {
      normal_.gradient[row] += weight * residual_m * j[row];
      for (int col = 0; col <= row; ++col) normal_.hessian(row, col) += weight * j[row] * j[col];
    }
  }

 private:
  PairNormal& normal_;
};

}  // namespace

PairNormal point_to_line(const ScanView& fixed, const ScanView& moving, const Pose2& T_fixed_moving,
                         double gate_m) {
  PairNormal normal;
  Sum sum(normal);
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
