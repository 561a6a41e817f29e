#include "engine/refine/settle/break_step.hpp"

#include <algorithm>
#include <functional>

namespace landfall::internal {

using Eigen::Vector2d;
using Eigen::VectorXd;

std::optional<VectorXd> break_worst_step(const SettleProblem& problem, const VectorXd& poses,
                                         int reach_cells) {
  constexpr double rare_nats = 8.0;  // where a map is off, corridors offer much by chance
  const std::size_t parts = problem.parts();
  const std::size_t side = 2 * static_cast<std::size_t>(reach_cells) + 1;
  std::vector<std::vector<std::int64_t>> before(parts + 1, std::vector<std::int64_t>(side * side, 0));
  for (std::size_t i = 0; i < parts; ++i) {
    const auto pose = poses.segment<3>(static_cast<Eigen::Index>(3 * i));
    const std::vector<std::int64_t> scores = problem.scores_around(i, pose, reach_cells);
    std::transform(before[i].begin(), before[i].end(), scores.begin(), before[i + 1].begin(), std::plus<>());
  }
  const auto offset = [&](std::size_t index) {
    const auto col = static_cast<int>(index % side);
    const auto row = static_cast<int>(index / side);
    return Vector2d(col - reach_cells, row - reach_cells);
  };
  const auto best_of = [](const std::vector<std::int64_t>& scores) {
    return static_cast<std::size_t>(std::max_element(scores.begin(), scores.end()) - scores.begin());
  };
  const std::vector<std::int64_t>& all = before.back();
  double least = problem.cost_of_score(all[best_of(all)]) - rare_nats;
  std::size_t broken = 0;
  Vector2d left = Vector2d::Zero();
  Vector2d right = Vector2d::Zero();
  for (std::size_t k = 1; k < parts; ++k) {
    std::vector<std::int64_t> after(side * side);
    std::transform(all.begin(), all.end(), before[k].begin(), after.begin(), std::minus<>());
    const std::size_t u = best_of(before[k]);
    const std::size_t v = best_of(after);
    const double cost = problem.cost_of_score(before[k][u] + after[v]) +
                        problem.cost_of_step((offset(v) - offset(u)).squaredNorm());
    if (cost >= least) continue;
    least = cost;
    broken = k;
    left = offset(u);
    right = offset(v);
  }
  if (broken == 0) return std::nullopt;
  VectorXd apart = poses;
  for (std::size_t i = 0; i < parts; ++i)
    apart.segment<2>(static_cast<Eigen::Index>(3 * i)) += i < broken ? left : right;
  return apart;
}

}  // namespace landfall::internal
