#include "engine/rank.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/evidence.hpp"

namespace landfall::internal {
namespace {

constexpr double nothing = -std::numeric_limits<double>::infinity();

double log_add(double a, double b) {
  if (a < b) std::swap(a, b);
  return std::isinf(b) ? a : a + std::log1p(std::exp(b - a));
}

}  // namespace

Modes find_modes(const Query& query, const std::vector<Candidate>& candidates, std::size_t most) {
  Modes found{.modes = {}, .log_rest = nothing, .log_elsewhere = nothing};
  if (candidates.empty()) return found;
  const std::size_t points = query.points.size();
  const double nats = evidence_nats(points);
  std::vector<Pose2> T_map_mode;
  for (const Candidate& candidate : candidates) {
    const Pose2 T_map_robot = query.lattice.T_map_robot(candidate.pose);
    const double log_mass =
        nats * share_of(candidate.score, points) + query.domain.log_prior(query.lattice, candidate.pose);
    std::size_t i = 0;
    while (i < T_map_mode.size() &&
           (translation_distance(T_map_mode[i], T_map_robot) >= query.options.distinct_translation_m ||
            angle_distance(T_map_mode[i].theta_rad, T_map_robot.theta_rad) >= query.options.distinct_rotation_rad))
      ++i;
    if (i < T_map_mode.size()) {
      found.modes[i].log_mass = log_add(found.modes[i].log_mass, log_mass);
    } else if (T_map_mode.size() < most) {
      found.modes.push_back({.best = candidate, .log_mass = log_mass, .map_index = 0, .hypothesis = {}});
      T_map_mode.push_back(T_map_robot);
    } else {
      found.log_rest = log_add(found.log_rest, log_mass);
    }
  }
  const Mode& best = found.modes.front();
  found.log_rest = log_add(found.log_rest, best.log_mass - rival_nats + std::log(unseen_weight));
  found.log_elsewhere = best.log_mass + nats * (chance_share(query) - share_of(best.best.score, points));
  return found;
}

void rank(const std::vector<Modes>& maps, int max_hypotheses, SearchResult& result) {
  std::vector<Mode> all;
  double most_explained = 0.0;
  for (const Modes& map : maps) {
    all.insert(all.end(), map.modes.begin(), map.modes.end());
    for (const Mode& mode : map.modes) most_explained = std::max(most_explained, mode.hypothesis.explained);
  }
  double log_total = nothing;
  for (Mode& mode : all) {
    mode.log_mass += explained_nats * (mode.hypothesis.explained - most_explained);
    log_total = log_add(log_total, mode.log_mass);
  }
  for (const Modes& map : maps) log_total = log_add(log_add(log_total, map.log_rest), map.log_elsewhere);
  std::stable_sort(all.begin(), all.end(), [](const Mode& a, const Mode& b) { return a.log_mass > b.log_mass; });
  if (all.size() > static_cast<std::size_t>(max_hypotheses)) all.resize(static_cast<std::size_t>(max_hypotheses));
  for (Mode& mode : all) {
    mode.hypothesis.probability = std::exp(mode.log_mass - log_total);
    mode.hypothesis.map_index = mode.map_index;
    result.hypotheses.push_back(mode.hypothesis);
  }
  constexpr double sure = 0.95;
  constexpr double explains = 0.5;
  if (result.hypotheses.empty()) {
    result.verdict = Verdict::lost;
    result.reason = "no echo falls near a wall from any pose of the prior";
  } else if (result.hypotheses.front().explained < explains) {
    result.verdict = Verdict::lost;
    result.reason = "no pose of the prior explains half of the beams";
  } else {
    result.verdict = result.hypotheses.front().probability >= sure ? Verdict::found : Verdict::ambiguous;
  }
}

}  // namespace landfall::internal
