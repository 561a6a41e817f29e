#include <algorithm>
#include <cmath>
#include <numeric>

#include "engine/evidence.hpp"
#include "engine/rank/rank.hpp"
#include "engine/sequence/hold_hypothesis.hpp"
#include "engine/sequence/sequence_model.hpp"
#include "landfall/consistent.hpp"

namespace landfall {
namespace {

using namespace internal;

// Less probable ones are not followed: a sequence that is worth less cannot be made good by a jump.
constexpr double followed_nats = 20.0;
constexpr std::size_t most_followed = 12;
constexpr double same_m = 0.1;
constexpr double same_rad = 0.02;

// Where a neighbour's hypothesis and odometry place the robot.
struct Expected {
  Pose2 T_map_robot;
  OdometrySigma sigma;
  int map_index;

  [[nodiscard]] bool is_near(const Pose2& T_map_other, int other_map_index) const {
    return other_map_index == map_index &&
           translation_distance(T_map_other, T_map_robot) <= sigma.translation_m &&
           angle_distance(T_map_other.theta_rad, T_map_robot.theta_rad) <= sigma.rotation_rad;
  }
  [[nodiscard]] Gaussian prior() const {
    const double square_m2 = sigma.translation_m * sigma.translation_m;
    return {.T_map_robot = T_map_robot,
            .covariance = {square_m2, 0, 0, 0, square_m2, 0, 0, 0, sigma.rotation_rad * sigma.rotation_rad}};
  }
};

std::vector<std::size_t> probable(const std::vector<double>& log_posterior) {
  std::vector<std::size_t> order;
  const double best = *std::max_element(log_posterior.begin(), log_posterior.end());
  for (std::size_t h = 0; h < log_posterior.size(); ++h)
    if (log_posterior[h] >= best - followed_nats) order.push_back(h);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return log_posterior[a] > log_posterior[b]; });
  if (order.size() > most_followed) order.resize(most_followed);
  return order;
}

// With the probability that its score deserves beside the best one there.
void add(SearchResult& result, Hypothesis added, int map_index) {
  added.map_index = map_index;
  for (const Hypothesis& known : result.hypotheses)
    if (known.map_index == map_index && translation_distance(known.T_map_robot, added.T_map_robot) < same_m &&
        angle_distance(known.T_map_robot.theta_rad, added.T_map_robot.theta_rad) < same_rad)
      return;
  if (!result.hypotheses.empty()) {
    const Hypothesis& best = result.hypotheses.front();
    const auto echoes = static_cast<std::size_t>(std::max(1, result.beams_echo));
    const double less = log_evidence(share_of(added.score, echoes), echoes) -
                        log_evidence(share_of(best.score, echoes), echoes);
    added.probability = best.probability * std::exp(std::min(0.0, less));
  }
  result.hypotheses.push_back(added);
}

class Follower {
 public:
  Follower(std::span<const PreparedMap> maps, std::span<const Scan> scans, std::vector<SearchResult>& results,
           const SearchOptions& search_options, const ConsistentOptions& options)
      : maps_(maps),
        scans_(scans),
        results_(results),
        search_options_(search_options),
        model_(results, odometry_of(scans), options) {}

  void pass(std::span<const std::size_t> order) {
    std::vector<double> log_posterior;
    std::size_t previous = order.size();
    for (const std::size_t here : order) {
      Pose2 T_previous_here;
      std::span<const Hypothesis> before;
      if (previous < order.size()) {
        T_previous_here = inverse(*scans_[previous].T_odom_robot) * *scans_[here].T_odom_robot;
        before = results_[previous].hypotheses;
        if (!before.empty()) look(before, log_posterior, T_previous_here, here);
      }
      if (results_[here].hypotheses.empty()) continue;
      log_posterior =
          model_.extend(before, log_posterior, results_[here].hypotheses, T_previous_here).log_posterior;
      previous = here;
    }
  }

 private:
  void look(std::span<const Hypothesis> before, const std::vector<double>& log_posterior,
            const Pose2& T_before_here, std::size_t here) {
    if (results_[here].beams_echo == 0) return;
    std::vector<Expected> expected;
    for (const std::size_t h : probable(log_posterior)) {
      const Expected one{.T_map_robot = before[h].T_map_robot * T_before_here,
                         .sigma = model_.transition_sigma(T_before_here),
                         .map_index = before[h].map_index};
      const auto& known = results_[here].hypotheses;
      const bool listed = std::any_of(known.begin(), known.end(), [&](const Hypothesis& other) {
        return one.is_near(other.T_map_robot, other.map_index);
      });
      const bool near_another = std::any_of(expected.begin(), expected.end(), [&](const Expected& other) {
        return one.is_near(other.T_map_robot, other.map_index);
      });
      const GridMap& grid = maps_[static_cast<std::size_t>(one.map_index)].grid();
      const bool on_map =
          grid.contains(grid.cell_of({.x_m = one.T_map_robot.x_m, .y_m = one.T_map_robot.y_m}));
      if (on_map && !listed && !near_another) expected.push_back(one);
    }
    ask(expected, here);
  }

  void ask(const std::vector<Expected>& expected, std::size_t here) {
    for (std::size_t m = 0; m < maps_.size(); ++m) {
      std::vector<PosePrior> priors;
      std::vector<Hypothesis> held;
      for (const Expected& one : expected) {
        if (one.map_index != static_cast<int>(m)) continue;
        priors.push_back({one.prior()});
        if (const auto hypothesis =
                hold_hypothesis(maps_[m], scans_[here], one.T_map_robot, one.sigma, search_options_))
          held.push_back(*hypothesis);
      }
      if (priors.empty()) continue;
      const std::vector<Scan> copies(priors.size(), scans_[here]);
      for (const SearchResult& answer : search(maps_.subspan(m, 1), priors, copies, search_options_))
        for (const Hypothesis& one : answer.hypotheses) add(results_[here], one, static_cast<int>(m));
      for (const Hypothesis& one : held) add(results_[here], one, static_cast<int>(m));
    }
  }

  std::span<const PreparedMap> maps_;
  std::span<const Scan> scans_;
  std::vector<SearchResult>& results_;
  const SearchOptions& search_options_;
  SequenceModel model_;
};

}  // namespace

std::vector<SearchResult> follow(std::span<const PreparedMap> maps, std::span<const Scan> scans,
                                 std::vector<SearchResult> results, const SearchOptions& search_options,
                                 const ConsistentOptions& options) {
  check_sequence("follow", maps, scans, results);
  check_options("follow", options);
  std::vector<std::size_t> order(scans.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  Follower follower(maps, scans, results, search_options, options);
  follower.pass(order);
  std::reverse(order.begin(), order.end());
  follower.pass(order);
  return results;
}

}  // namespace landfall
