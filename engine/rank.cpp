#include "engine/rank.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/evidence.hpp"

namespace landfall::internal {
namespace {

constexpr double unexplained_nats = 20.0;
constexpr double nothing = -std::numeric_limits<double>::infinity();

double log_add(double a, double b) {
  if (a < b) std::swap(a, b);
  return std::isinf(b) ? a : a + std::log1p(std::exp(b - a));
}

// What ray casting adds to the score: an end point well behind a wall counts against the pose, even
// where it meets another wall; one well before the wall is held against it less than the field does.
double share_of_rays(const Verification& verification) {
  return ray_share * (verification.blocked - verification.seen_through);
}

}  // namespace

Modes find_modes(const Query& query, const std::vector<Candidate>& candidates, std::size_t most) {
  constexpr std::size_t most_counted = 64;
  const std::size_t points = query.points.size();
  Modes found{.modes = {}, .log_rest = nothing, .nats = evidence_nats(points), .points = points};
  std::vector<Pose2> T_map_mode;
  for (const Candidate& candidate : candidates) {
    const Pose2 T_map_robot = query.lattice.T_map_robot(candidate.pose);
    const bool known = std::any_of(T_map_mode.begin(), T_map_mode.end(), [&](const Pose2& T_map_other) {
      return translation_distance(T_map_other, T_map_robot) < query.options.distinct_translation_m &&
             angle_distance(T_map_other.theta_rad, T_map_robot.theta_rad) <
                 query.options.distinct_rotation_rad;
    });
    if (known) continue;
    if (T_map_mode.size() >= most_counted) break;
    T_map_mode.push_back(T_map_robot);
    const double log_mass = found.nats * share_of(candidate.score, points) +
                            query.domain.log_prior(query.lattice, candidate.pose);
    if (found.modes.size() < most) {
      found.modes.push_back({.best = candidate,
                             .log_mass = log_mass,
                             .share = 0.0,
                             .map_index = 0,
                             .verification = {},
                             .hypothesis = {}});
    } else {
      found.log_rest = log_add(found.log_rest, log_mass);
    }
  }
  return found;
}

void rank(const std::vector<Modes>& maps, int max_hypotheses, SearchResult& result) {
  std::vector<Mode> all;
  double log_total = nothing;
  bool any_explains = false;
  for (const Modes& map : maps)
    for (const Mode& mode : map.modes)
      any_explains = any_explains || mode.hypothesis.explained >= least_explained;
  for (const Modes& map : maps) {
    log_total = log_add(log_total, map.log_rest);
    for (Mode mode : map.modes) {
      const double lattice_share = share_of(mode.best.score, map.points);
      mode.log_mass += map.nats * (mode.share - lattice_share + share_of_rays(mode.verification));
      // A pose that would be lost by itself is no rival of one that explains the scan.
      if (any_explains && mode.hypothesis.explained < least_explained) mode.log_mass -= unexplained_nats;
      mode.share = lattice_share;
      log_total = log_add(log_total, mode.log_mass);
      all.push_back(std::move(mode));
    }
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const Mode& a, const Mode& b) { return a.log_mass > b.log_mass; });
  if (!all.empty()) {
    const Mode& best = all.front();
    log_total = log_add(
        log_total,
        best.log_mass + std::log(unseen_weight + elsewhere_weight(best.share, best.hypothesis.explained)));
  }
  if (all.size() > static_cast<std::size_t>(max_hypotheses))
    all.resize(static_cast<std::size_t>(max_hypotheses));
  for (Mode& mode : all) {
    mode.hypothesis.probability = std::exp(mode.log_mass - log_total);
    mode.hypothesis.map_index = mode.map_index;
    result.hypotheses.push_back(mode.hypothesis);
  }
  constexpr double sure = 0.95;
  if (result.hypotheses.empty()) {
    result.verdict = Verdict::lost;
    result.reason = result.proven ? "no echo falls near a wall from any pose of the prior"
                                  : "the time budget ended before any pose was scored";
  } else if (result.hypotheses.front().explained < least_explained) {
    result.verdict = Verdict::lost;
    result.reason = "no pose of the prior explains half of the beams";
  } else {
    result.verdict = result.hypotheses.front().probability >= sure ? Verdict::found : Verdict::ambiguous;
  }
}

}  // namespace landfall::internal
