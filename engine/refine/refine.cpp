#include "engine/refine/refine.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "engine/refine/field_normal.hpp"

namespace landfall::internal {
namespace {

// Covariance of the pose in metres: residuals' variance over the information of the points.
std::array<double, 9> covariance_of(const FieldNormal& normal, std::size_t points, const Lattice& lattice) {
  // A direction that no point constrains (a corridor's axis) is known to about a metre.
  constexpr double widest_m = 1.0;
  Eigen::Vector3d unit(lattice.resolution_m, lattice.resolution_m, 1.0);
  const double variance =
      std::max(0.01, normal.cost / std::max<double>(1.0, static_cast<double>(points) - 3.0));
  Eigen::Matrix3d information =
      unit.cwiseInverse().asDiagonal() * normal.hessian * unit.cwiseInverse().asDiagonal();
  information /= variance;
  information.diagonal() += Eigen::Vector3d::Constant(1.0 / (widest_m * widest_m));
  const Eigen::Rotation2Dd turn(lattice.T_map_grid.theta_rad);
  Eigen::Matrix3d to_map = Eigen::Matrix3d::Identity();
  to_map.topLeftCorner<2, 2>() = turn.toRotationMatrix();
  const Eigen::Matrix3d covariance = to_map * information.inverse() * to_map.transpose();
  std::array<double, 9> rows{};
  Eigen::Map<Eigen::Matrix3d>(rows.data()) = 0.5 * (covariance + covariance.transpose());
  return rows;
}

struct Optimum {
  Eigen::Vector3d pose;
  FieldNormal normal;
};

// Damped Gauss-Newton within `reach` of `center`.
Optimum descend(const PreparedState& map, const EndPoints& points, const Eigen::Vector3d& start,
                const Eigen::Vector3d& center, const Eigen::Vector3d& reach, Residual residual) {
  constexpr int most_iterations = 12;
  constexpr double least_gain = 1e-4;  // of the cost: well below a millimetre
  Optimum at{.pose = start, .normal = linearise(map, points, start, residual)};
  double damping = 1e-3;
  for (int i = 0; i < most_iterations; ++i) {
    Eigen::Matrix3d damped = at.normal.hessian;
    damped.diagonal() += damping * (at.normal.hessian.diagonal() + Eigen::Vector3d::Constant(1e-9));
    const Eigen::Vector3d step = damped.ldlt().solve(at.normal.gradient);
    const Eigen::Vector3d next = (at.pose + step).cwiseMax(center - reach).cwiseMin(center + reach);
    if (!next.allFinite()) break;
    const FieldNormal there = linearise(map, points, next, residual);
    if (there.cost >= at.normal.cost) {
      damping *= 10.0;
      if (damping > 1e3) break;
      continue;
    }
    const double gain = at.normal.cost - there.cost;
    at = {.pose = next, .normal = there};
    damping = std::max(1e-6, damping * 0.1);
    if (gain < least_gain * at.normal.cost) break;
  }
  return at;
}

}  // namespace

Refined refine(const PreparedState& map, const EndPoints& points, const Lattice& lattice,
               const Pose2& T_map_start) {
  constexpr double most_steps = 1.5;
  const Pose2 T_grid_start = inverse(lattice.T_map_grid) * T_map_start;
  const Eigen::Vector3d start(T_grid_start.x_m / lattice.resolution_m,
                              T_grid_start.y_m / lattice.resolution_m, T_grid_start.theta_rad);
  const Eigen::Vector3d reach =
      most_steps * Eigen::Vector3d(lattice.step_cells, lattice.step_cells, lattice.heading_step_rad());
  const Optimum rough = descend(map, points, start, start, reach, Residual::lack);
  const Optimum fine = descend(map, points, rough.pose, start, reach, Residual::root);
  const Pose2 T_grid_robot{fine.pose[0] * lattice.resolution_m, fine.pose[1] * lattice.resolution_m,
                           fine.pose[2]};
  return {.T_map_robot = lattice.T_map_grid * T_grid_robot,
          .covariance = covariance_of(fine.normal, points.size(), lattice),
          .share = rough.normal.field / static_cast<double>(std::max<std::size_t>(1, points.size()))};
}

}  // namespace landfall::internal
