#include "engine/mapping/slam/surface_map.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "engine/align/residual_sum.hpp"
#include "engine/align/twist.hpp"
#include "engine/base/rigid.hpp"

namespace landfall::internal {
namespace {

constexpr double square_m = 0.1;
constexpr double least_facing = 0.7;  // cosine between normals of one surface
constexpr int most_iterations = 20;
constexpr double first_gate_m = 0.25;
constexpr double last_gate_m = 0.12;
constexpr double gate_decay = 0.85;
constexpr double settled = 2e-5;  // metres and radians
constexpr int well_known = 5;     // points of a surface that is no chance
constexpr double join_m = 0.075;
constexpr double forget_m = 0.05;
// How far the start may be off where no surface tells.
constexpr double start_sigma_m = 0.2;
constexpr double start_sigma_rad = 0.2;

double dot(const Point2& a, const Point2& b) {
  return a.x_m * b.x_m + a.y_m * b.y_m;
}

}  // namespace

CellIndex SurfaceMap::square_of(const Point2& p_map) {
  return {.col = static_cast<int>(std::floor(p_map.x_m / square_m)),
          .row = static_cast<int>(std::floor(p_map.y_m / square_m))};
}

void SurfaceMap::add_scan(std::span<const SurfacePoint> points_robot, const Pose2& T_map_robot) {
  if (points_robot.empty()) return;
  const CellIndex start = square_of({.x_m = T_map_robot.x_m, .y_m = T_map_robot.y_m});
  CellBox box{.low = start, .high = start};
  const Rigid to_map(T_map_robot);
  for (const SurfacePoint& point : points_robot) {
    const CellIndex cell = square_of(to_map.point(point.p));
    box.low = {.col = std::min(box.low.col, cell.col), .row = std::min(box.low.row, cell.row)};
    box.high = {.col = std::max(box.high.col, cell.col), .row = std::max(box.high.row, cell.row)};
  }
  slots_.cover(box);
  for (const SurfacePoint& point : points_robot)
    if (point.has_normal) add(to_map.point(point.p), to_map.direction(point.normal));
}

void SurfaceMap::Surface::add(const Point2& p_map, const Point2& normal_map) {
  ++count;
  mean.x_m += (p_map.x_m - mean.x_m) / count;
  mean.y_m += (p_map.y_m - mean.y_m) / count;
  normal_sum.x_m += normal_map.x_m;
  normal_sum.y_m += normal_map.y_m;
  const double length = std::hypot(normal_sum.x_m, normal_sum.y_m);
  normal = {.x_m = normal_sum.x_m / length, .y_m = normal_sum.y_m / length};
}

// To the surface that is there already, in whichever square its mean lies: a wall near a border between
// squares is one row of surfaces, not two that share its echoes.
void SurfaceMap::add(const Point2& p_map, const Point2& normal_map) {
  const std::int32_t known = nearest(p_map, normal_map, join_m);
  if (known != none) {
    surfaces_[static_cast<std::size_t>(known)].add(p_map, normal_map);
    return;
  }
  for (std::int32_t& slot : slots_[square_of(p_map)].surface) {
    if (slot != none && surfaces_[static_cast<std::size_t>(slot)].count > 0) continue;
    if (slot == none) {
      slot = static_cast<std::int32_t>(surfaces_.size());
      surfaces_.emplace_back();
    }
    surfaces_[static_cast<std::size_t>(slot)].add(p_map, normal_map);
    return;
  }
}

void SurfaceMap::forget(std::span<const Point2> points_map) {
  for (const Point2& p_map : points_map) {
    const CellIndex square = square_of(p_map);
    if (!slots_.contains(square)) continue;
    for (const std::int32_t slot : slots_[square].surface) {
      if (slot == none) continue;
      Surface& surface = surfaces_[static_cast<std::size_t>(slot)];
      if (std::hypot(surface.mean.x_m - p_map.x_m, surface.mean.y_m - p_map.y_m) <= forget_m) surface = {};
    }
  }
}

std::int32_t SurfaceMap::nearest(const Point2& p_map, const Point2& normal_map, double gate_m) const {
  const CellIndex center = square_of(p_map);
  std::int32_t best = none;
  double best_squared = gate_m * gate_m;
  for (int row = center.row - 1; row <= center.row + 1; ++row)
    for (int col = center.col - 1; col <= center.col + 1; ++col)
      for (const std::int32_t slot : slots_.at({.col = col, .row = row}).surface) {
        if (slot == none) continue;
        const Surface& surface = surfaces_[static_cast<std::size_t>(slot)];
        if (surface.count == 0 || dot(surface.normal, normal_map) < least_facing) continue;
        const double dx = p_map.x_m - surface.mean.x_m;
        const double dy = p_map.y_m - surface.mean.y_m;
        const double squared = dx * dx + dy * dy;
        if (squared >= best_squared) continue;
        best_squared = squared;
        best = slot;
      }
  return best;
}

Pose2 SurfaceMap::refine(std::span<const SurfacePoint> points_robot, const Pose2& T_map_start) const {
  constexpr double per_m2 = 1.0 / (start_sigma_m * start_sigma_m);
  const Eigen::Vector3d stiffness(per_m2, per_m2, 1.0 / (start_sigma_rad * start_sigma_rad));
  Pose2 T_map_robot = T_map_start;
  double gate_m = first_gate_m;
  for (int i = 0; i < most_iterations; ++i) {
    PairNormal normal = linearise(points_robot, T_map_robot, gate_m);
    normal.hessian.diagonal() += stiffness;
    normal.gradient += stiffness.cwiseProduct(difference(T_map_robot, T_map_start));
    const Eigen::Vector3d motion = -normal.hessian.ldlt().solve(normal.gradient);
    if (!motion.allFinite()) break;
    T_map_robot = {.x_m = T_map_robot.x_m + motion[0],
                   .y_m = T_map_robot.y_m + motion[1],
                   .theta_rad = wrap_angle(T_map_robot.theta_rad + motion[2])};
    if (gate_m == last_gate_m && motion.cwiseAbs().maxCoeff() < settled) break;
    gate_m = std::max(last_gate_m, gate_decay * gate_m);
  }
  return T_map_robot;
}

// Of motions about the robot, so that turning and shifting part.
PairNormal SurfaceMap::linearise(std::span<const SurfacePoint> points_robot, const Pose2& T_map_robot,
                                 double gate_m) const {
  PairNormal normal;
  ResidualSum sum(normal);
  const Rigid to_map(T_map_robot);
  for (const SurfacePoint& point : points_robot) {
    if (!point.has_normal) continue;
    const Point2 p_map = to_map.point(point.p);
    const std::int32_t near = nearest(p_map, to_map.direction(point.normal), gate_m);
    if (near == none) continue;
    const Surface& surface = surfaces_[static_cast<std::size_t>(near)];
    const double residual_m = surface.distance(p_map);
    const Point2 p_about{.x_m = p_map.x_m - T_map_robot.x_m, .y_m = p_map.y_m - T_map_robot.y_m};
    sum.add(surface.normal.x_m, surface.normal.y_m, p_about, residual_m, residual_m);
  }
  normal.hessian.triangularView<Eigen::StrictlyUpper>() = normal.hessian.transpose();
  return normal;
}

std::optional<double> SurfaceMap::distance(const Point2& p_map, const Point2& normal_map) const {
  const std::int32_t near = nearest(p_map, normal_map, 1.5 * square_m);
  if (near == none) return std::nullopt;
  return std::abs(surfaces_[static_cast<std::size_t>(near)].distance(p_map));
}

bool SurfaceMap::is_noise_of_a_wall(const Point2& p_map, const Point2& p_end_map, double noise_m) const {
  const CellIndex center = square_of(p_map);
  for (int row = center.row - 1; row <= center.row + 1; ++row)
    for (int col = center.col - 1; col <= center.col + 1; ++col)
      for (const std::int32_t slot : slots_.at({.col = col, .row = row}).surface) {
        if (slot == none) continue;
        const Surface& surface = surfaces_[static_cast<std::size_t>(slot)];
        if (surface.count < well_known) continue;
        const double before_m = surface.distance(p_map);
        if (std::abs(before_m) > noise_m || surface.distance(p_end_map) < -noise_m) continue;
        const double along_m = std::hypot(p_map.x_m - surface.mean.x_m, p_map.y_m - surface.mean.y_m);
        if (along_m <= square_m) return true;
      }
  return false;
}

}  // namespace landfall::internal
