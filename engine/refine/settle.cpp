#include "engine/refine/settle.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "engine/refine/settle/break_step.hpp"

namespace landfall::internal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

struct Optimum {
  VectorXd poses;
  double cost;
};

Optimum descend(const SettleProblem& problem, VectorXd poses) {
  constexpr int most_iterations = 15;
  double damping = 1e-3;
  SettleProblem::Linear at = problem.linearise(poses);
  for (int i = 0; i < most_iterations; ++i) {
    MatrixXd damped = at.hessian;
    damped.diagonal() += damping * (at.hessian.diagonal() + VectorXd::Constant(poses.size(), 1e-6));
    const VectorXd next = poses + damped.ldlt().solve(at.gradient);
    if (!next.allFinite()) break;
    SettleProblem::Linear there = problem.linearise(next);
    if (there.cost >= at.cost) {
      damping *= 10.0;
      if (damping > 1e3) break;
      continue;
    }
    const double gain = at.cost - there.cost;
    poses = next;
    at = std::move(there);
    damping = std::max(1e-6, damping * 0.1);
    if (gain < 1e-3) break;
  }
  return {.poses = std::move(poses), .cost = at.cost};
}

}  // namespace

std::vector<std::vector<Pose2>> settle(const SettleProblem& problem, const Pose2& T_map_robot) {
  constexpr double farthest_off_m = 0.5;
  constexpr double most_cells = 20.0;
  std::vector<Pose2> T_map_start;
  for (const Pose2& T_reference_robot : problem.T_reference_robot())
    T_map_start.push_back(T_map_robot * T_reference_robot);
  const VectorXd whole = problem.in_cells(T_map_start);
  std::vector<std::vector<Pose2>> ways{problem.in_metres(descend(problem, whole).poses)};
  const auto reach =
      static_cast<int>(std::lround(std::min(most_cells, farthest_off_m / problem.resolution_m())));
  if (const std::optional<VectorXd> broken = break_worst_step(problem, whole, reach))
    ways.push_back(problem.in_metres(descend(problem, *broken).poses));
  return ways;
}

std::vector<Pose2> settle(const SettleProblem& problem, std::span<const std::vector<Pose2>> T_map_starts) {
  Optimum best{.poses = {}, .cost = std::numeric_limits<double>::infinity()};
  for (const std::vector<Pose2>& T_map_start : T_map_starts) {
    Optimum found = descend(problem, problem.in_cells(T_map_start));
    if (found.cost < best.cost) best = std::move(found);
  }
  return problem.in_metres(best.poses);
}

Scan remount(const Scan& scan, const std::vector<Pose2>& T_map_part) {
  const ScanParts& parts = *scan.parts;
  Scan settled = scan;
  auto sensor = std::make_shared<Sensor>(*scan.sensor);
  const Pose2 T_reference_map = inverse(T_map_part[parts.reference]);
  std::size_t beam = 0;
  for (std::size_t i = 0; i < parts.beams.size(); ++i) {
    const Pose2 T_reference_part = T_reference_map * T_map_part[i];
    const Pose2 T_settled_given = T_reference_part * inverse(parts.T_reference_robot[i]);
    for (const std::size_t end = beam + parts.beams[i]; beam < end; ++beam)
      sensor->beams[beam].T_robot_beam = T_settled_given * scan.sensor->beams[beam].T_robot_beam;
    settled.parts->T_reference_robot[i] = T_reference_part;
  }
  settled.sensor = std::move(sensor);
  return settled;
}

}  // namespace landfall::internal
