#include "landfall/consistent.hpp"

#include <algorithm>
#include <string>

#include "engine/sequence/sequence_model.hpp"
#include "landfall/error.hpp"

namespace landfall {

using internal::SequenceModel;

std::vector<int> consistent(std::span<const SearchResult> results, std::span<const Pose2> T_odom_robot,
                            const ConsistentOptions& options) {
  if (results.size() != T_odom_robot.size())
    throw Error(ErrorCode::invalid_argument, "consistent: " + std::to_string(results.size()) +
                                                 " results and " + std::to_string(T_odom_robot.size()) +
                                                 " odometry poses, expected as many");
  internal::check_options("consistent", options);
  for (std::size_t i = 0; i < T_odom_robot.size(); ++i)
    if (!is_finite(T_odom_robot[i]))
      throw Error(ErrorCode::invalid_argument,
                  "consistent: odometry pose " + std::to_string(i) + " is not finite");
  std::vector<std::size_t> answered;
  for (std::size_t i = 0; i < results.size(); ++i)
    if (!results[i].hypotheses.empty()) answered.push_back(i);
  std::vector<int> choice(results.size(), -1);
  if (answered.empty()) return choice;

  const SequenceModel model(results, T_odom_robot, options);
  std::vector<std::vector<int>> came_from;
  std::vector<double> log_posterior;
  for (std::size_t a = 0; a < answered.size(); ++a) {
    const std::size_t here = answered[a];
    const std::size_t previous = a > 0 ? answered[a - 1] : here;
    const auto before = a > 0 ? std::span(results[previous].hypotheses) : std::span<const Hypothesis>();
    SequenceModel::Extended next = model.extend(before, log_posterior, results[here].hypotheses,
                                                inverse(T_odom_robot[previous]) * T_odom_robot[here]);
    log_posterior = std::move(next.log_posterior);
    came_from.push_back(std::move(next.came_from));
  }
  const auto best = std::max_element(log_posterior.begin(), log_posterior.end());
  auto at = static_cast<int>(best - log_posterior.begin());
  for (std::size_t a = answered.size(); a-- > 0;) {
    choice[answered[a]] = at;
    at = came_from[a][static_cast<std::size_t>(at)];
  }
  return choice;
}

}  // namespace landfall
