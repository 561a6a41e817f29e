#include "engine/refine/refine_by_ranges.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "engine/maps/to_raycast.hpp"

namespace landfall::internal {
namespace {

constexpr double step_m = 0.002;
constexpr double step_rad = 0.0005;
// A difference over a step in which the beam jumps from one wall to another says nothing.
constexpr double most_slope = 20.0;       // per metre
constexpr double most_slope_rad = 100.0;  // metres per radian

struct Echoes {
  std::vector<raycast::Beam> beams;
  std::vector<double> range_m;
  double noise_m = 0.0;  // one sigma at the mean range
};

Echoes echoes_of(const Scan& scan) {
  const Sensor& sensor = *scan.sensor;
  const std::vector<raycast::Beam> all = to_raycast(sensor);
  Echoes echoes;
  double sum_m = 0.0;
  for (std::size_t b = 0; b < all.size(); ++b) {
    if (all[b].half_angle_rad > 0.0 || classify(sensor.beams[b], scan.ranges_m[b]) != Reading::echo) continue;
    echoes.beams.push_back(all[b]);
    echoes.range_m.push_back(scan.ranges_m[b]);
    sum_m += scan.ranges_m[b];
  }
  const auto count = static_cast<double>(std::max<std::size_t>(1, echoes.beams.size()));
  echoes.noise_m = std::max(0.001, sensor.range_noise_m + sensor.range_noise_relative * sum_m / count);
  return echoes;
}

Pose2 moved(const Pose2& pose, const Eigen::Vector3d& step) {
  return {pose.x_m + step[0], pose.y_m + step[1], wrap_angle(pose.theta_rad + step[2])};
}

// The squared residuals' sum, linearised: a step solves hessian * step = gradient.
struct Linearised {
  Eigen::Matrix3d hessian = Eigen::Matrix3d::Zero();
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
  double squares = 0.0;  // weighted
  double weights = 0.0;
};

class RangeResiduals {
 public:
  RangeResiduals(const PreparedState& map, Echoes echoes)
      : scene_(map.scene()), echoes_(std::move(echoes)), simulated_m_(4 * echoes_.beams.size()) {}

  [[nodiscard]] double noise_m() const { return echoes_.noise_m; }
  [[nodiscard]] std::int64_t rays_cast() const { return rays_cast_; }

  Linearised at(const Pose2& T_map_robot, double width_m) {
    const std::array<raycast::Pose, 4> poses{to_raycast(T_map_robot),
                                             to_raycast(moved(T_map_robot, {step_m, 0.0, 0.0})),
                                             to_raycast(moved(T_map_robot, {0.0, step_m, 0.0})),
                                             to_raycast(moved(T_map_robot, {0.0, 0.0, step_rad}))};
    cast(poses, simulated_m_);
    const std::size_t count = echoes_.beams.size();
    Linearised sum;
    for (std::size_t b = 0; b < count; ++b) {
      const double here_m = simulated_m_[b];
      const Eigen::Vector3d slope((simulated_m_[count + b] - here_m) / step_m,
                                  (simulated_m_[2 * count + b] - here_m) / step_m,
                                  (simulated_m_[3 * count + b] - here_m) / step_rad);
      if (!slope.allFinite() || std::abs(slope[0]) > most_slope || std::abs(slope[1]) > most_slope ||
          std::abs(slope[2]) > most_slope_rad)
        continue;
      const double off_m = echoes_.range_m[b] - here_m;
      const double weight = std::pow(1.0 / (1.0 + off_m * off_m / (width_m * width_m)), 2);
      sum.hessian += weight * slope * slope.transpose();
      sum.gradient += weight * off_m * slope;
      sum.squares += weight * off_m * off_m;
      sum.weights += weight;
    }
    return sum;
  }

  // Of Geman and McClure: less is better.
  double cost(const Pose2& T_map_robot, double width_m) {
    const raycast::Pose pose = to_raycast(T_map_robot);
    const std::span<float> simulated_m = std::span(simulated_m_).first(echoes_.beams.size());
    cast(std::span(&pose, 1), simulated_m);
    double sum = 0.0;
    for (std::size_t b = 0; b < simulated_m.size(); ++b) {
      const double squared = std::pow((echoes_.range_m[b] - simulated_m[b]) / width_m, 2);
      sum += std::isfinite(squared) ? squared / (1.0 + squared) : 1.0;
    }
    return sum;
  }

 private:
  void cast(std::span<const raycast::Pose> poses, std::span<float> simulated_m) {
    scene_.cast_fans(poses, echoes_.beams, simulated_m);
    rays_cast_ += static_cast<std::int64_t>(simulated_m.size());
  }

  const raycast::Scene& scene_;
  Echoes echoes_;
  std::vector<float> simulated_m_;  // of the pose, and of it moved along x, y and theta
  std::int64_t rays_cast_ = 0;
};

std::array<double, 9> covariance_of(const Linearised& at, double noise_m) {
  constexpr double widest_m = 1.0;  // a direction that no beam constrains (a corridor's axis)
  const double variance = std::max(noise_m * noise_m, at.squares / std::max(1.0, at.weights - 3.0));
  Eigen::Matrix3d information = at.hessian / variance;
  information.diagonal() += Eigen::Vector3d::Constant(1.0 / (widest_m * widest_m));
  const Eigen::Matrix3d covariance = information.inverse();
  std::array<double, 9> rows{};
  Eigen::Map<Eigen::Matrix3d>(rows.data()) = 0.5 * (covariance + covariance.transpose());
  return rows;
}

}  // namespace

RefinedByRanges refine_by_ranges(const PreparedState& map, const Scan& scan, const Pose2& T_map_start,
                                 const RefineReach& reach) {
  constexpr int most_iterations = 14;
  constexpr double first_width_m = 0.3;
  constexpr double narrowing = 0.6;
  constexpr double small_m = 1e-4;
  RangeResiduals residuals(map, echoes_of(scan));
  const double last_width_m = 3.0 * residuals.noise_m();
  const Eigen::Vector3d limit(reach.translation_m, reach.translation_m, reach.rotation_rad);
  Eigen::Vector3d moved_by = Eigen::Vector3d::Zero();
  double width_m = std::max(first_width_m, last_width_m);
  for (int i = 0; i < most_iterations; ++i) {
    const Linearised there = residuals.at(moved(T_map_start, moved_by), width_m);
    Eigen::Matrix3d damped = there.hessian;
    damped.diagonal() += 1e-3 * there.hessian.diagonal() + Eigen::Vector3d::Constant(1e-6);
    const Eigen::Vector3d before = moved_by;
    const Eigen::Vector3d step = damped.ldlt().solve(there.gradient);
    if (!step.allFinite()) break;
    moved_by = (moved_by + step).cwiseMax(-limit).cwiseMin(limit);
    const bool settled = width_m <= last_width_m && (moved_by - before).cwiseAbs().maxCoeff() < small_m;
    if (settled) break;
    width_m = std::max(last_width_m, narrowing * width_m);
  }
  const Pose2 T_map_end = moved(T_map_start, moved_by);
  const bool better = residuals.cost(T_map_end, last_width_m) < residuals.cost(T_map_start, last_width_m);
  const Pose2 T_map_robot = better ? T_map_end : T_map_start;
  const Linearised there = residuals.at(T_map_robot, last_width_m);
  return {.T_map_robot = T_map_robot,
          .covariance = covariance_of(there, residuals.noise_m()),
          .rays_cast = residuals.rays_cast()};
}

}  // namespace landfall::internal
