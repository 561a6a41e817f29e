// The pipeline on one screen: propose, refine, verify, rank.
#include "landfall/search.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <optional>
#include <string>

#include "engine/base/options.hpp"
#include "engine/base/parallel.hpp"
#include "engine/lattice_score.hpp"
#include "engine/methods/table.hpp"
#include "engine/priors/central_heading.hpp"
#include "engine/priors/off_map.hpp"
#include "engine/rank/judge_by_readings.hpp"
#include "engine/rank/range_posterior.hpp"
#include "engine/rank/rank.hpp"
#include "engine/refine/refine.hpp"
#include "engine/refine/refine_by_ranges.hpp"
#include "engine/refine/settle.hpp"
#include "engine/verify/verify.hpp"
#include "kernels/isa.hpp"
#include "landfall/error.hpp"

namespace landfall {
namespace internal {
namespace {

double ms_since(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

// Adds the time until it goes out of scope.
class StageTimer {
 public:
  explicit StageTimer(double& total_ms) : total_ms_(total_ms) {}
  ~StageTimer() { total_ms_ += ms_since(start_); }
  StageTimer(const StageTimer&) = delete;
  StageTimer& operator=(const StageTimer&) = delete;

 private:
  double& total_ms_;
  Clock::time_point start_ = Clock::now();
};

// So many modes are refined and verified even where fewer hypotheses are asked for: the best score is
// not always the most probable pose.
constexpr int least_modes = 8;

// A map with what all scans of a call share.
struct PreparedQuestion {
  const PreparedState& map;
  // One for all scans, or one per scan.
  std::vector<Lattice> lattices;
  std::vector<Domain> domains;

  [[nodiscard]] const Lattice& lattice(std::size_t scan) const {
    return lattices.size() == 1 ? lattices.front() : lattices[scan];
  }
  [[nodiscard]] const Domain& domain(std::size_t scan) const {
    return domains.size() == 1 ? domains.front() : domains[scan];
  }
};

// "fft (AVX2)" becomes "fft (AVX2, direct)"; several maps may be searched in several ways.
void name_way(const std::string& way, SearchResult& result) {
  if (way.empty() || result.method.find(", " + way) != std::string::npos) return;
  result.method.insert(result.method.size() - 1, ", " + way);
}

Proposal propose(const Query& query, const Method& method, SearchResult& result) {
  const StageTimer timer(result.times.propose_ms);
  Proposal proposal = method.propose(query);
  result.proven = result.proven && proposal.proven;
  result.counts.poses_scored += proposal.counts.poses_scored;
  result.counts.bounds_computed += proposal.counts.bounds_computed;
  result.counts.rays_cast += proposal.counts.rays_cast;
  name_way(proposal.way, result);
  return proposal;
}

void refine_modes(const Query& query, const Method& method, Modes& found, SearchResult& result) {
  const StageTimer timer(result.times.refine_ms);
  std::optional<SettleProblem> problem;
  if (query.scan.parts) problem.emplace(query.map, query.scan);
  // The field is polished along the beams' axes, where a cone's echo need not be.
  const std::vector<Beam>& beams = query.scan.sensor->beams;
  const bool cones =
      std::any_of(beams.begin(), beams.end(), [](const Beam& b) { return b.half_angle_rad > 0.0; });
  std::atomic<std::int64_t> rays_cast{0};
  parallel_for(found.modes.size(), query.threads, [&](std::size_t i) {
    Mode& mode = found.modes[i];
    Hypothesis& hypothesis = mode.hypothesis;
    hypothesis.score = mode.free ? mode.free->score : mode.best.score;
    hypothesis.T_map_robot_unrefined =
        mode.free ? mode.free->T_map_robot : query.lattice.T_map_robot(mode.best.pose);
    Pose2 T_map_start = hypothesis.T_map_robot_unrefined;
    std::optional<RefinedByRanges> exact;
    if (method.refines_by_ranges && query.map.is_plan()) {
      exact = refine_by_ranges(query.map, query.scan, T_map_start);
      T_map_start = exact->T_map_robot;
      rays_cast += exact->rays_cast;
      if (const auto beside = best_on_lattice_beside(query, T_map_start)) mode.best = *beside;
    }
    const Refined refined = refine(query.map, query.points, query.lattice, T_map_start);
    const bool by_mean = found.by_ranges && cones;
    hypothesis.T_map_robot = exact ? T_map_start : by_mean ? mode.T_map_mean : refined.T_map_robot;
    hypothesis.covariance = exact ? exact->covariance : refined.covariance;
    mode.share = refined.share;
    if (problem) mode.ways_to_settle = settle(*problem, hypothesis.T_map_robot);
  });
  result.counts.rays_cast += rays_cast;
}

// The way to settle that the map explains more of; the first where it is the same.
void verify_settled(const Query& query, Mode& mode) {
  mode.verification.explained = -1.0;
  for (const std::vector<Pose2>& T_map_part : mode.ways_to_settle) {
    const Pose2& T_map_robot = T_map_part[query.scan.parts->reference];
    const Verification verification =
        verify(query.map, remount(query.scan, T_map_part), std::span(&T_map_robot, 1)).front();
    if (verification.explained <= mode.verification.explained) continue;
    mode.verification = verification;
    mode.hypothesis.T_map_robot = T_map_robot;
  }
}

void verify_modes(const Query& query, Modes& found, SearchResult& result) {
  const StageTimer timer(result.times.verify_ms);
  std::size_t poses = found.modes.size();
  if (query.scan.parts) {
    poses = 0;
    for (const Mode& mode : found.modes) poses += mode.ways_to_settle.size();
    parallel_for(found.modes.size(), query.threads,
                 [&](std::size_t i) { verify_settled(query, found.modes[i]); });
  } else {
    std::vector<Pose2> T_map_robot;
    for (const Mode& mode : found.modes) T_map_robot.push_back(mode.hypothesis.T_map_robot);
    const std::vector<Verification> verified = verify(query.map, query.scan, T_map_robot);
    for (std::size_t i = 0; i < verified.size(); ++i) found.modes[i].verification = verified[i];
  }
  for (Mode& mode : found.modes) mode.hypothesis.explained = mode.verification.explained;
  result.counts.rays_cast += static_cast<std::int64_t>(poses) * result.beams_valid;
}

void judge_modes(const Query& query, Modes& found, SearchResult& result) {
  const StageTimer timer(result.times.verify_ms);
  judge_by_readings(query, found, result.counts);
}

Modes examine(const Query& query, const Method& method, SearchResult& result) {
  const Proposal proposal = propose(query, method, result);
  Modes modes = [&] {
    const StageTimer timer(result.times.rank_ms);
    const int least = query.scan.measured ? least_judged_modes : least_modes;
    const auto most = static_cast<std::size_t>(std::max(query.options.max_hypotheses, least));
    return proposal.scores != Scores::field
               ? find_modes_by_ranges(query, proposal, most)
               : find_modes(query, proposal.candidates, most, proposal.free_candidates);
  }();
  result.counts.rays_cast += modes.rays_cast;
  refine_modes(query, method, modes, result);
  if (method.samples) drop_repeated(query.options, modes.modes);
  judge_modes(query, modes, result);
  verify_modes(query, modes, result);
  return modes;
}

// The field does not know what stands between: where every pose found sees through walls, one that does
// not may score less. Looked for where that is cheap: with so wide a margin bounds exclude little.
bool deserves_second_look(const Query& query, const Method& method, const Modes& modes) {
  constexpr std::int64_t most_poses = 100'000'000;
  if (modes.by_ranges || method.samples) return false;  // of other scores the margin is the method's
  if (query.scan.measured) return false;                // the margin is as wide already
  if (query.domain.poses > most_poses || query.out_of_time()) return false;
  return !modes.modes.empty() && std::none_of(modes.modes.begin(), modes.modes.end(), [](const Mode& mode) {
    return mode.hypothesis.explained >= least_explained;
  });
}

constexpr const char* stopped = "stopped before any pose was scored";

// Why there is nothing to go by; empty where there is.
std::string nothing_to_go_by(const SearchResult& result) {
  if (result.beams_valid == 0) return "no valid beam";
  if (result.beams_echo == 0) return "no beam has an echo";
  if (result.counts.poses_covered == 0) return "the prior holds no free cell";
  return {};
}

SearchResult search_scan(const std::vector<PreparedQuestion>& maps, std::size_t index, const Scan& scan,
                         const std::optional<Guess>& guess, const SearchOptions& options,
                         const Method& method, int threads) {
  SearchResult result;
  const StageTimer timer(result.times.total_ms);
  const Clock::time_point start = Clock::now();
  result.stamp_s = scan.stamp_s;
  result.method = std::string(method.info.name) + " (" + active_isa() + ")";
  result.beams_valid = count_valid(scan);
  result.beams_echo = count_echoes(scan);
  for (const PreparedQuestion& map : maps) result.counts.poses_covered += map.domain(index).poses;
  result.reason = options.stop.stop_requested() ? stopped : nothing_to_go_by(result);
  if (!result.reason.empty()) return result;
  result.proven = true;
  std::vector<Modes> found;
  for (std::size_t m = 0; m < maps.size(); ++m) {
    if (maps[m].domain(index).poses == 0) continue;
    const EndPoints points = make_end_points(scan, maps[m].lattice(index).resolution_m);
    Query query{.map = maps[m].map,
                .scan = scan,
                .points = points,
                .lattice = maps[m].lattice(index),
                .domain = maps[m].domain(index),
                .options = options,
                .margin = scan.measured ? second_margin(points.size()) : rival_margin(points.size()),
                .threads = threads,
                .deadline = deadline_of(start, options.time_budget_s)};
    if (guess && guess->map_index == static_cast<int>(m)) query.guess = guess;
    Modes modes = examine(query, method, result);
    if (deserves_second_look(query, method, modes)) {
      query.margin = second_margin(points.size());
      modes = examine(query, method, result);
    }
    if (modes.modes.empty()) continue;  // a map without any pose says nothing of the others'
    for (Mode& mode : modes.modes) mode.map_index = static_cast<int>(m);
    found.push_back(std::move(modes));
  }
  const StageTimer rank_timer(result.times.rank_ms);
  rank(found, options.max_hypotheses, result);
  const bool in_time = options.time_budget_s <= 0.0 || ms_since(start) < 1e3 * options.time_budget_s;
  if (result.hypotheses.empty() && !result.proven && in_time) result.reason = "no pose was found that fits";
  if (result.hypotheses.empty() && options.stop.stop_requested()) result.reason = stopped;
  return result;
}

void require_on_map(const std::vector<PreparedQuestion>& questions, std::span<const PreparedMap> maps,
                    std::span<const PosePrior> priors) {
  for (std::size_t i = 0; i < priors.size(); ++i) {
    const bool on_map = std::any_of(questions.begin(), questions.end(),
                                    [i](const PreparedQuestion& map) { return map.domains[i].on_map; });
    if (!on_map) throw Error(ErrorCode::invalid_argument, off_map_text(priors, i, maps));
  }
}

std::vector<PreparedQuestion> prepare_questions(std::span<const PreparedMap> maps,
                                                std::span<const PosePrior> priors,
                                                const SearchOptions& options, const Method& method) {
  std::vector<PreparedQuestion> questions;
  for (const PreparedMap& map : maps) {
    map.prepare();
    const Lattice lattice = make_lattice(map.grid(), options.translation_step_m, options.rotation_step_rad);
    PreparedQuestion question{.map = map.state(),
                              .lattices = std::vector<Lattice>(priors.size(), lattice),
                              .domains = std::vector<Domain>(priors.size())};
    const SharedMask free = question.map.free_mask(options.robot_radius_m, lattice.step_cells);
    parallel_for(priors.size(), options.threads, [&](std::size_t i) {
      if (method.centers_headings) question.lattices[i] = centered_on(priors[i], lattice);
      question.domains[i] = make_domain(priors[i], question.lattices[i], free);
    });
    questions.push_back(std::move(question));
  }
  require_on_map(questions, maps, priors);
  return questions;
}

}  // namespace
}  // namespace internal

using namespace internal;

std::vector<SearchResult> search(std::span<const PreparedMap> maps, std::span<const PosePrior> priors,
                                 std::span<const Scan> scans, const SearchOptions& options) {
  validate(options);
  const Method& method = find_method(options.method);
  if (maps.empty()) throw Error(ErrorCode::invalid_argument, "search: no map");
  if (priors.size() != 1 && priors.size() != scans.size())
    throw Error(ErrorCode::invalid_argument, "search: " + std::to_string(priors.size()) + " priors for " +
                                                 std::to_string(scans.size()) +
                                                 " scans, expected 1 or one per scan");
  for (const PosePrior& prior : priors) validate(prior);
  for (const Scan& scan : scans) validate(scan);
  validate_environment();
  const Clock::time_point start = Clock::now();
  const std::vector<PreparedQuestion> questions = prepare_questions(maps, priors, options, method);
  const double prepare_ms = ms_since(start);
  std::vector<SearchResult> results(scans.size());
  // Many scans run side by side, each in one thread; a single one gets all of them.
  const bool side_by_side = scans.size() > 1;
  Answers answers(scans, results);
  parallel_for(scans.size(), side_by_side ? options.threads : 1, [&](std::size_t i) {
    answers.give(i, search_scan(questions, i, scans[i], answers.guess(i), options, method,
                                side_by_side ? 1 : options.threads));
  });
  if (!results.empty()) {
    results.front().times.prepare_ms = prepare_ms;
    results.front().times.total_ms += prepare_ms;
  }
  return results;
}

std::vector<SearchResult> search(const PreparedMap& map, std::span<const PosePrior> priors,
                                 std::span<const Scan> scans, const SearchOptions& options) {
  return search(std::span(&map, 1), priors, scans, options);
}

std::vector<SearchResult> search(const PreparedMap& map, const PosePrior& prior, std::span<const Scan> scans,
                                 const SearchOptions& options) {
  return search(std::span(&map, 1), std::span(&prior, 1), scans, options);
}

SearchResult search(const PreparedMap& map, const PosePrior& prior, const Scan& scan,
                    const SearchOptions& options) {
  return search(map, prior, std::span(&scan, 1), options).front();
}

std::span<const MethodInfo> methods() {
  static const std::vector<MethodInfo> infos = [] {
    std::vector<MethodInfo> all;
    for (const Method& method : method_table()) all.push_back(method.info);
    return all;
  }();
  return infos;
}

std::string_view to_string(Verdict verdict) {
  switch (verdict) {
    case Verdict::found:
      return "found";
    case Verdict::ambiguous:
      return "ambiguous";
    case Verdict::lost:
      return "lost";
  }
  return "unknown";
}

}  // namespace landfall
