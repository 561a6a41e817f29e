#include "engine/align/overlap.hpp"

#include <algorithm>
#include <cmath>

namespace landfall::internal {
namespace {

constexpr double surface_sigma_m = 0.06;
constexpr double reach_m = 0.25;
constexpr double least_facing = 0.7;  // cosine between the normals

// Distance to the surface that a point is on, in the frame of that surface; negative where it is on none.
double distance_to(const SurfacePoint& surface, const Point2& p, const Point2& normal, bool has_normal) {
  const double dx = p.x_m - surface.p.x_m;
  const double dy = p.y_m - surface.p.y_m;
  const double squared = dx * dx + dy * dy;
  if (squared >= reach_m * reach_m) return -1.0;
  if (!surface.has_normal) return std::sqrt(squared);
  const double facing = normal.x_m * surface.normal.x_m + normal.y_m * surface.normal.y_m;
  if (has_normal && facing < least_facing) return -1.0;
  return std::abs(surface.normal.x_m * dx + surface.normal.y_m * dy);
}

double share_of_points(const ScanView& viewer, const ScanView& seen, const Pose2& T_viewer_seen) {
  constexpr double nowhere = unseen_value / 255.0;
  const double c = std::cos(T_viewer_seen.theta_rad);
  const double s = std::sin(T_viewer_seen.theta_rad);
  double sum = 0.0;
  for (const SurfacePoint& point : seen.points()) {
    const Point2 p{.x_m = T_viewer_seen.x_m + c * point.p.x_m - s * point.p.y_m,
                   .y_m = T_viewer_seen.y_m + s * point.p.x_m + c * point.p.y_m};
    const std::ptrdiff_t cell = viewer.index_of(p.x_m, p.y_m);
    if (cell < 0) {
      sum += nowhere;
      continue;
    }
    double value = viewer.background(cell) / 255.0;
    if (const SurfacePoint* surface = viewer.nearest(cell)) {
      const Point2 normal{.x_m = c * point.normal.x_m - s * point.normal.y_m,
                          .y_m = s * point.normal.x_m + c * point.normal.y_m};
      const double off = distance_to(*surface, p, normal, point.has_normal) / surface_sigma_m;
      if (off >= 0.0) value = std::max(value, std::exp(-0.5 * off * off));
    }
    sum += value;
  }
  return sum / static_cast<double>(seen.points().size());
}

}  // namespace

double overlap_share(const ScanView& a, const ScanView& b, const Pose2& T_a_b) {
  if (a.points().empty() || b.points().empty()) return 0.0;
  return 0.5 * (share_of_points(a, b, T_a_b) + share_of_points(b, a, inverse(T_a_b)));
}

double overlap_nats(std::size_t points) {
  return 12.8 * std::pow(static_cast<double>(points), 0.25);
}

double overlap_nats(const ScanView& a, const ScanView& b) {
  return overlap_nats(std::min(a.points().size(), b.points().size()));
}

}  // namespace landfall::internal
