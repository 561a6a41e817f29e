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

enum class Residual {
  lack,  // 1 - field: the paper's. Flat near a wall, it listens to points that are off.
  root   // its square root, near a wall the distance: it listens to points that fit.
};

// Residuals of the end points; pose in cells and radians in the grid's frame.
Normal linearise(const PreparedState& map, const EndPoints& points, const Eigen::Vector3d& pose,
                 Residual residual) {
  constexpr double least_lack = 0.02;  // the root is steep at 0
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
    const double lack = 1.0 - at.value;
    const bool root = residual == Residual::root;
    normal.cost += root ? lack : lack * lack;
    normal.field += at.value;
    const Eigen::Vector3d slope(at.d_col, at.d_row, at.d_row * x - at.d_col * y);
    const double weight = root ? 0.25 / std::max(least_lack, lack) : 1.0;
    normal.hessian.noalias() += weight * slope * slope.transpose();
    normal.gradient += (root ? 0.5 : lack) * slope;
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

struct Optimum {
  Eigen::Vector3d pose;
  Normal normal;
};

// Damped Gauss-Newton within `reach` of `center`.
Optimum descend(const PreparedState& map, const EndPoints& points, const Eigen::Vector3d& start,
                const Eigen::Vector3d& center, const Eigen::Vector3d& reach, Residual residual) {
  constexpr int most_iterations = 12;
  Optimum at{.pose = start, .normal = linearise(map, points, start, residual)};
  double damping = 1e-3;
  for (int i = 0; i < most_iterations; ++i) {
    Eigen::Matrix3d damped = at.normal.hessian;
    damped.diagonal() += damping * (at.normal.hessian.diagonal() + Eigen::Vector3d::Constant(1e-9));
    const Eigen::Vector3d step = damped.ldlt().solve(at.normal.gradient);
    const Eigen::Vector3d next = (at.pose + step).cwiseMax(center - reach).cwiseMin(center + reach);
    if (!next.allFinite()) break;
    const Normal there = linearise(map, points, next, residual);
    if (there.cost >= at.normal.cost) {
      damping *= 10.0;
      if (damping > 1e3) break;
      continue;
    }
    const double gain = at.normal.cost - there.cost;
    at = {.pose = next, .normal = there};
    damping = std::max(1e-6, damping * 0.1);
    if (gain < 1e-6 * at.normal.cost) break;
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
