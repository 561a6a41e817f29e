#include "engine/rank/rank.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/evidence.hpp"

namespace landfall::internal {
namespace {

constexpr double unexplained_nats = 20.0;
constexpr double nothing = -std::numeric_limits<double>::infinity();

// What ray casting adds to the score: an end point well behind a wall counts against the pose, even
// where it meets another wall; one well before the wall is held against it less than the field does.
double share_of_rays(const Verification& verification) {
  return ray_share * (verification.blocked - verification.seen_through);
}

// The score of the best lattice pose beside that of the pose: points are off by up to half a step, which
// costs a Gaussian field half their variance over its own. What the finest lattices miss is not counted.
double missed_share(const Query& query) {
  constexpr double always = 0.03;
  const Lattice& lattice = query.lattice;
  double squared_cells = 0.0;
  for (std::size_t i = 0; i < query.points.size(); ++i)
    squared_cells +=
        query.points.x_cells[i] * query.points.x_cells[i] + query.points.y_cells[i] * query.points.y_cells[i];
  const double mean_squared_cells =
      squared_cells / static_cast<double>(std::max<std::size_t>(1, query.points.size()));
  const double turned = lattice.heading_step_rad() * lattice.heading_step_rad() * mean_squared_cells;
  const double moved = 2.0 * lattice.step_cells * lattice.step_cells;
  const double sigma_cells = query.map.options().field_sigma_m / lattice.resolution_m;
  return std::clamp(0.5 * (turned + moved) / 12.0 / (sigma_cells * sigma_cells) - always, 0.0, 1.0);
}

bool are_one_mode(const SearchOptions& options, const Pose2& T_map_a, const Pose2& T_map_b) {
  return translation_distance(T_map_a, T_map_b) < options.distinct_translation_m &&
         angle_distance(T_map_a.theta_rad, T_map_b.theta_rad) < options.distinct_rotation_rad;
}

}  // namespace

Modes find_modes(const Query& query, const std::vector<Candidate>& candidates, std::size_t most,
                 std::span<const FreeCandidate> free_candidates) {
  constexpr std::size_t most_counted = 64;
  const std::size_t points = query.points.size();
  Modes found{.modes = {}, .log_rest = nothing, .missed_share = missed_share(query), .points = points};
  std::vector<Pose2> T_map_mode;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    const Candidate& candidate = candidates[i];
    const std::optional<FreeCandidate> free =
        free_candidates.empty() ? std::nullopt : std::optional(free_candidates[i]);
    const Pose2 T_map_robot = free ? free->T_map_robot : query.lattice.T_map_robot(candidate.pose);
    const bool known = std::any_of(T_map_mode.begin(), T_map_mode.end(), [&](const Pose2& T_map_other) {
      return are_one_mode(query.options, T_map_other, T_map_robot);
    });
    if (known) continue;
    if (T_map_mode.size() >= most_counted) break;
    T_map_mode.push_back(T_map_robot);
    const double share = share_of(candidate.score, points);
    const double log_prior = query.domain.log_prior(query.lattice, candidate.pose);
    if (found.modes.size() < most) {
      found.modes.push_back({.best = candidate,
                             .free = free,
                             .log_prior = log_prior,
                             .share = share,
                             .log_mass = 0.0,
                             .log_readings = 0.0,
                             .T_map_mean = {},
                             .map_index = 0,
                             .verification = {},
                             .ways_to_settle = {},
                             .hypothesis = {}});
    } else {
      found.log_rest = log_add(found.log_rest, log_prior + log_evidence(share, points));
    }
  }
  return found;
}

void drop_repeated(const SearchOptions& options, std::vector<Mode>& modes) {
  std::vector<Mode> distinct;
  for (Mode& mode : modes) {
    const bool known = std::any_of(distinct.begin(), distinct.end(), [&](const Mode& other) {
      return are_one_mode(options, other.hypothesis.T_map_robot, mode.hypothesis.T_map_robot);
    });
    if (!known) distinct.push_back(std::move(mode));
  }
  modes = std::move(distinct);
}

namespace {

struct Ranked {
  const Modes* map;  // whose mode it is
  Mode mode;
  double log_mass;  // prior x likelihood
};

// log_readings: of the mode that they speak for most, so that what was not judged weighs what it did.
double log_mass(const Modes& map, const Mode& mode, double log_readings) {
  if (map.by_ranges) return mode.log_mass;
  return mode.log_prior + log_evidence(mode.share + share_of_rays(mode.verification), map.points) +
         (mode.log_readings - log_readings);
}

double most_log_readings(const std::vector<Modes>& maps) {
  double most = nothing;
  for (const Modes& map : maps)
    for (const Mode& mode : map.modes) most = std::max(most, mode.log_readings);
  return most;
}

// What weighs beside the best pose that it is none.
double elsewhere(const Ranked& best) {
  const double lattice_share = share_of(best.mode.best.score, best.map->points);
  const double share = std::min(1.0, lattice_share + best.map->missed_share);
  const Verification& verification = best.mode.verification;
  return elsewhere_weight(share + blocked_share * verification.blocked, verification.held_m2);
}

std::vector<Ranked> in_order(const std::vector<Modes>& maps) {
  bool any_explains = false;
  for (const Modes& map : maps)
    for (const Mode& mode : map.modes)
      any_explains = any_explains || mode.hypothesis.explained >= least_explained;
  const double log_readings = most_log_readings(maps);
  std::vector<Ranked> all;
  for (const Modes& map : maps) {
    for (const Mode& mode : map.modes) {
      double weight = log_mass(map, mode, log_readings);
      // A pose that would be lost by itself is no rival of one that explains the scan.
      if (any_explains && !map.by_ranges && mode.hypothesis.explained < least_explained)
        weight -= unexplained_nats;
      all.push_back({&map, mode, weight});
    }
  }
  const bool as_they_come = maps.size() == 1 && maps.front().in_order;
  if (!as_they_come)
    std::stable_sort(all.begin(), all.end(),
                     [](const Ranked& a, const Ranked& b) { return a.log_mass > b.log_mass; });
  return all;
}

// What a rival that explains more beams than the best pose weighs: up to as much as that one.
void weigh_disagreement(std::vector<Ranked>& all) {
  const Ranked& best = all.front();
  for (Ranked& rival : all) {
    const double more = rival.mode.hypothesis.explained - best.mode.hypothesis.explained;
    rival.log_mass = std::min(best.log_mass, rival.log_mass + explains_more_nats * std::max(0.0, more));
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const Ranked& a, const Ranked& b) { return a.log_mass > b.log_mass; });
}

// Of everything: the modes, those beyond them, poses never looked at, and being elsewhere.
double log_total(const std::vector<Modes>& maps, const std::vector<Ranked>& all) {
  double total = nothing;
  for (const Modes& map : maps) total = log_add(total, map.log_rest);
  for (const Ranked& one : all) total = log_add(total, one.log_mass);
  const Ranked& best = all.front();
  return log_add(total, best.log_mass + std::log(unseen_weight + elsewhere(best)));
}

// The same by ranges: the posterior knows all the poses that it compared.
double log_total_by_ranges(const std::vector<Modes>& maps, const Ranked& best) {
  double total = maps.front().log_elsewhere + std::log(elsewhere_odds);
  for (const Modes& map : maps) total = log_add(total, map.log_all);
  return log_add(total, best.log_mass + std::log(unseen_weight));
}

void decide(SearchResult& result) {
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

}  // namespace

void rank(const std::vector<Modes>& maps, int max_hypotheses, SearchResult& result) {
  std::vector<Ranked> all = in_order(maps);
  if (!all.empty()) {
    const bool by_ranges = maps.front().by_ranges;
    if (!by_ranges) weigh_disagreement(all);
    const double total = by_ranges ? log_total_by_ranges(maps, all.front()) : log_total(maps, all);
    if (all.size() > static_cast<std::size_t>(max_hypotheses))
      all.resize(static_cast<std::size_t>(max_hypotheses));
    for (Ranked& one : all) {
      Hypothesis& hypothesis = result.hypotheses.emplace_back(one.mode.hypothesis);
      hypothesis.probability = std::exp(one.log_mass - total);
      hypothesis.map_index = one.mode.map_index;
    }
  }
  decide(result);
}

}  // namespace landfall::internal
