#include "engine/refine.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace landfall::internal {
namespace {

struct FieldSample {
  double value;  // 0..1
  double d_col;  // per cell
  double d_row;
};

// Bilinear between cell centres, 0 outside the map. Position in cells from the grid's corner.
FieldSample sample(const std::uint8_t* field, int width, int height, double x_cells, double y_cells) {
  const double x = x_cells - 0.5;
  const double y = y_cells - 0.5;
  const double col = std::floor(x);
  const double row = std::floor(y);
  if (!(col >= 0.0 && row >= 0.0 && col + 1.0 < width && row + 1.0 < height)) return {0.0, 0.0, 0.0};
  const double fx = x - col;
  const double fy = y - row;
  const std::uint8_t* at =
      field + static_cast<std::ptrdiff_t>(row) * width + static_cast<std::ptrdiff_t>(col);
  constexpr double scale = 1.0 / 255.0;
  const double v00 = at[0] * scale;
  const double v01 = at[1] * scale;
  const double v10 = at[width] * scale;
  const double v11 = at[width + 1] * scale;
  const double low = v00 + fx * (v01 - v00);
  const double high = v10 + fx * (v11 - v10);
  return {low + fy * (high - low), (1.0 - fy) * (v01 - v00) + fy * (v11 - v10), high - low};
}

struct Normal {
  Eigen::Matrix3d hessian = Eigen::Matrix3d::Zero();
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
  double cost = 0.0;
  double field = 0.0;  // sum over the points
};

// Residuals 1 - field(end point); pose in cells and radians in the grid's frame.
Normal linearise(const PreparedState& map, const EndPoints& points, const Eigen::Vector3d& pose) {
  const std::uint8_t* field = map.field().data();
  const int width = map.grid().width_cells;
  const int height = map.grid().height_cells;
  const double c = std::cos(pose[2]);
  const double s = std::sin(pose[2]);
  Normal normal;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double x = c * points.x_cells[i] - s * points.y_cells[i];
    const double y = s * points.x_cells[i] + c * points.y_cells[i];
    const FieldSample at = sample(field, width, height, pose[0] + x, pose[1] + y);
    const double residual = 1.0 - at.value;
    normal.cost += residual * residual;
    normal.field += at.value;
    const Eigen::Vector3d slope(at.d_col, at.d_row, at.d_row * x - at.d_col * y);
    normal.hessian.noalias() += slope * slope.transpose();
    normal.gradient += residual * slope;
  }
  return normal;
}

// Covariance of the pose in metres: residuals' variance over the information of the points.
std::array<double, 9> covariance_of(const Normal& normal, std::size_t points, const Lattice& lattice) {
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

}  // namespace

Refined refine(const PreparedState& map, const EndPoints& points, const Lattice& lattice,
               const Pose2& T_map_start) {
  constexpr int most_iterations = 12;
  constexpr double most_steps = 1.5;
  const Pose2 T_grid_start = inverse(lattice.T_map_grid) * T_map_start;
  const Eigen::Vector3d start(T_grid_start.x_m / lattice.resolution_m,
                              T_grid_start.y_m / lattice.resolution_m, T_grid_start.theta_rad);
  const Eigen::Vector3d reach =
      most_steps * Eigen::Vector3d(lattice.step_cells, lattice.step_cells, lattice.heading_step_rad());
  Eigen::Vector3d pose = start;
  Normal at = linearise(map, points, pose);
  double damping = 1e-3;
  for (int i = 0; i < most_iterations; ++i) {
    Eigen::Matrix3d damped = at.hessian;
    damped.diagonal() += damping * (at.hessian.diagonal() + Eigen::Vector3d::Constant(1e-9));
    const Eigen::Vector3d step = damped.ldlt().solve(at.gradient);
    const Eigen::Vector3d next = (pose + step).cwiseMax(start - reach).cwiseMin(start + reach);
    if (!next.allFinite()) break;
    const Normal there = linearise(map, points, next);
    if (there.cost >= at.cost) {
      damping *= 10.0;
      if (damping > 1e3) break;
      continue;
    }
    const double gain = at.cost - there.cost;
    pose = next;
    at = there;
    damping = std::max(1e-6, damping * 0.1);
    if (gain < 1e-6 * at.cost) break;
  }
  const Pose2 T_grid_robot{pose[0] * lattice.resolution_m, pose[1] * lattice.resolution_m, pose[2]};
  return {.T_map_robot = lattice.T_map_grid * T_grid_robot,
          .covariance = covariance_of(at, points.size(), lattice),
          .share = at.field / static_cast<double>(std::max<std::size_t>(1, points.size()))};
}

}  // namespace landfall::internal
