#include "engine/refine/settle/problem.hpp"

#include <algorithm>
#include <cmath>

#include "engine/evidence.hpp"
#include "engine/refine/field_normal.hpp"

namespace landfall::internal {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr double least_sigma_m = 1e-3;
constexpr double least_sigma_rad = 1e-3;

}  // namespace

SettleProblem::SettleProblem(const PreparedState& map, const Scan& scan)
    : map_(map), T_reference_robot_(scan.parts->T_reference_robot) {
  const ScanParts& parts = *scan.parts;
  const double resolution_m = map.grid().resolution_m;
  std::size_t beam = 0;
  for (std::size_t i = 0; i < parts.beams.size(); ++i) {
    const Pose2 T_robot_reference = inverse(parts.T_reference_robot[i]);
    EndPoints& points = points_.emplace_back();
    for (const std::size_t end = beam + parts.beams[i]; beam < end; ++beam) {
      const Beam& mounted = scan.sensor->beams[beam];
      if (classify(mounted, scan.ranges_m[beam]) != Reading::echo) continue;
      const Point2 p = T_robot_reference * mounted.T_robot_beam * Point2{scan.ranges_m[beam], 0.0};
      if (std::max(std::abs(p.x_m), std::abs(p.y_m)) > farthest_cells * resolution_m) continue;
      points.x_cells.push_back(p.x_m / resolution_m);
      points.y_cells.push_back(p.y_m / resolution_m);
    }
    count_ += points.size();
  }
  scans_ = std::pow(static_cast<double>(parts.beams.size()), 0.75);
  for (std::size_t i = 0; i + 1 < parts.beams.size(); ++i)
    steps_.push_back(in_cells(inverse(parts.T_reference_robot[i]) * parts.T_reference_robot[i + 1]));
  const double per_cell = resolution_m / std::max(least_sigma_m, parts.noise.translation_m);
  const double per_rad = 1.0 / std::max(least_sigma_rad, parts.noise.rotation_rad);
  weight_ = Vector3d(per_cell * per_cell, per_cell * per_cell, per_rad * per_rad);
  reference_ = static_cast<Eigen::Index>(3 * parts.reference);
}

void SettleProblem::expect_reference(const Pose2& T_map_reference, double sigma_m, double sigma_rad) {
  expected_ = in_cells(inverse(map_.grid().T_map_grid) * T_map_reference);
  const double per_cell = resolution_m() / std::max(least_sigma_m, sigma_m);
  const double per_rad = 1.0 / std::max(least_sigma_rad, sigma_rad);
  expected_weight_ = scans_ * Vector3d(per_cell * per_cell, per_cell * per_cell, per_rad * per_rad);
}

SettleProblem::Linear SettleProblem::linearise(const VectorXd& poses) const {
  const auto size = poses.size();
  Linear sum{.hessian = MatrixXd::Zero(size, size), .gradient = VectorXd::Zero(size)};
  double field = 0.0;
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(3 * i);
    const FieldNormal normal = internal::linearise(map_, points_[i], poses.segment<3>(at), Residual::root);
    sum.hessian.block<3, 3>(at, at) = normal.hessian;
    sum.gradient.segment<3>(at) = normal.gradient;
    field += normal.field;
  }
  const auto count = static_cast<double>(std::max<std::size_t>(1, count_));
  const double share = field / count;
  const double nats_per_point = 2.0 * scans_ * evidence_slope(share, count_) / count;
  sum.hessian *= nats_per_point;
  sum.gradient *= nats_per_point;
  sum.cost = -scans_ * log_evidence(share, count_);
  for (std::size_t i = 0; i < steps_.size(); ++i) hold(i, poses, sum);
  hold_reference(poses, sum);
  return sum;
}

void SettleProblem::hold_reference(const VectorXd& poses, Linear& sum) const {
  Vector3d off = poses.segment<3>(reference_) - expected_;
  off[2] = wrap_angle(off[2]);
  sum.cost += 0.5 * off.dot(expected_weight_.cwiseProduct(off));
  sum.hessian.block<3, 3>(reference_, reference_) += expected_weight_.asDiagonal();
  sum.gradient.segment<3>(reference_) -= expected_weight_.cwiseProduct(off);
}

void SettleProblem::hold(std::size_t i, const VectorXd& poses, Linear& sum) const {
  const auto at = static_cast<Eigen::Index>(3 * i);
  const Vector3d before = poses.segment<3>(at);
  const Vector3d after = poses.segment<3>(at + 3);
  const double c = std::cos(before[2]);
  const double s = std::sin(before[2]);
  const double x = after[0] - before[0];
  const double y = after[1] - before[1];
  const Vector3d off(c * x + s * y - steps_[i][0], -s * x + c * y - steps_[i][1],
                     wrap_angle(after[2] - before[2] - steps_[i][2]));
  Eigen::Matrix<double, 3, 6> slope;
  slope << -c, -s, -s * x + c * y, c, s, 0.0,  //
      s, -c, -c * x - s * y, -s, c, 0.0,       //
      0.0, 0.0, -1.0, 0.0, 0.0, 1.0;
  const double squared = off.dot(weight_.cwiseProduct(off));
  sum.cost += std::log1p(0.5 * squared);
  const Vector3d weight = weight_ / (1.0 + 0.5 * squared);
  sum.hessian.block<6, 6>(at, at) += slope.transpose() * weight.asDiagonal() * slope;
  sum.gradient.segment<6>(at) -= slope.transpose() * weight.cwiseProduct(off);
}

std::vector<std::int64_t> SettleProblem::scores_around(std::size_t i, const Vector3d& pose, int reach) const {
  const std::size_t side = 2 * static_cast<std::size_t>(reach) + 1;
  std::vector<std::int64_t> scores(side * side, 0);
  const GridMap& grid = map_.grid();
  const std::uint8_t* field = map_.field().data();
  const double c = std::cos(pose[2]);
  const double s = std::sin(pose[2]);
  for (std::size_t p = 0; p < points_[i].size(); ++p) {
    const double x = points_[i].x_cells[p];
    const double y = points_[i].y_cells[p];
    const auto col = static_cast<int>(std::floor(pose[0] + c * x - s * y));
    const auto row = static_cast<int>(std::floor(pose[1] + s * x + c * y));
    for (int dy = std::max(-reach, -row); dy <= std::min(reach, grid.height_cells - 1 - row); ++dy) {
      const std::uint8_t* at = field + static_cast<std::ptrdiff_t>(row + dy) * grid.width_cells + col;
      std::int64_t* to = scores.data() + static_cast<std::size_t>(dy + reach) * side;
      for (int dx = std::max(-reach, -col); dx <= std::min(reach, grid.width_cells - 1 - col); ++dx)
        to[dx + reach] += at[dx];
    }
  }
  return scores;
}

double SettleProblem::cost_of_score(std::int64_t score) const {
  const double most = 255.0 * static_cast<double>(std::max<std::size_t>(1, count_));
  return -scans_ * log_evidence(static_cast<double>(score) / most, count_);
}

double SettleProblem::cost_of_step(double off_squared_cells) const {
  return std::log1p(0.5 * weight_[0] * off_squared_cells);
}

Vector3d SettleProblem::in_cells(const Pose2& pose) const {
  return {pose.x_m / map_.grid().resolution_m, pose.y_m / map_.grid().resolution_m, pose.theta_rad};
}

VectorXd SettleProblem::in_cells(const std::vector<Pose2>& T_map_part) const {
  VectorXd poses(static_cast<Eigen::Index>(3 * T_map_part.size()));
  const Pose2 T_grid_map = inverse(map_.grid().T_map_grid);
  for (std::size_t i = 0; i < T_map_part.size(); ++i)
    poses.segment<3>(static_cast<Eigen::Index>(3 * i)) = in_cells(T_grid_map * T_map_part[i]);
  return poses;
}

std::vector<Pose2> SettleProblem::in_metres(const VectorXd& poses) const {
  const double resolution_m = map_.grid().resolution_m;
  std::vector<Pose2> T_map_part;
  for (Eigen::Index i = 0; i + 2 < poses.size(); i += 3)
    T_map_part.push_back(map_.grid().T_map_grid * Pose2{poses[i] * resolution_m, poses[i + 1] * resolution_m,
                                                        wrap_angle(poses[i + 2])});
  return T_map_part;
}

}  // namespace landfall::internal
