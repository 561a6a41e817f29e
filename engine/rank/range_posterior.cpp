#include "engine/rank/range_posterior.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "engine/base/parallel.hpp"
#include "engine/evidence.hpp"
#include "engine/maps/to_raycast.hpp"
#include "engine/rank/beam_model.hpp"
#include "engine/rank/neighbourhoods.hpp"

namespace landfall::internal {
namespace {

constexpr double nothing = -std::numeric_limits<double>::infinity();
constexpr std::size_t most_compared = 256;  // poses of the lattice
constexpr std::size_t most_neighbourhoods = 256;
constexpr std::size_t most_members = 32;    // of each
constexpr std::size_t most_in_order = 64;   // best scores, where they decide
constexpr std::size_t most_refined = 48;    // of these, by poses within the cell
constexpr double least_refined_nats = 9.0;  // below the best one
constexpr std::size_t poses_per_task = 64;
// So much likelier than those of a place off the map are ranges that say something.
constexpr double ranges_fail_nats = 10.0;
constexpr double score_nats = 15.0;  // from the best score to none

struct Sample {
  Pose2 T_map_robot;
  double log_mass;  // prior x likelihood x its part of the cell
  std::size_t candidate;
  bool taken = false;
};

struct Centre {
  std::size_t candidate;
  double mass;  // within a step of the lattice, over that of the likeliest pose
};

// Each half a step around the lattice's pose.
std::vector<Pose2> poses_within_cell(const Lattice& lattice, const Pose2& T_map_robot) {
  const double step_m = 0.25 * lattice.step_cells * lattice.resolution_m;
  const double step_rad = 0.25 * lattice.heading_step_rad();
  const double c = std::cos(lattice.T_map_grid.theta_rad);
  const double s = std::sin(lattice.T_map_grid.theta_rad);
  std::vector<Pose2> poses;
  for (const double x : {-step_m, step_m})
    for (const double y : {-step_m, step_m})
      for (const double turn : {-step_rad, step_rad})
        poses.push_back({.x_m = T_map_robot.x_m + c * x - s * y,
                         .y_m = T_map_robot.y_m + s * x + c * y,
                         .theta_rad = wrap_angle(T_map_robot.theta_rad + turn)});
  return poses;
}

class RangePosterior {
 public:
  RangePosterior(const Query& query, const Proposal& proposal)
      : query_(query),
        model_(query.map.grid(), query.scan),
        in_order_(proposal.scores == Scores::own_decide) {
    log_elsewhere_ = model_.log_likelihood_elsewhere() + ranges_fail_nats;
    best_score_ = proposal.candidates.front().score;
    choose_candidates(proposal.candidates);
    for (const Candidate& candidate : candidates_)
      T_map_candidate_.push_back(query.lattice.T_map_robot(candidate.pose));
    weigh_lattice();
    refine();
    find_centres();
  }

  Modes modes(std::size_t most) {
    Modes found;
    found.points = query_.points.size();
    found.by_ranges = true;
    found.in_order = in_order_;
    found.log_elsewhere = log_elsewhere_;
    found.log_all = log_best_ + std::log(all_);
    found.rays_cast = rays_cast_;
    for (const Centre& centre : centres_) {
      if (found.modes.size() >= most) break;
      const std::size_t i = centre.candidate;
      const bool known = std::any_of(found.modes.begin(), found.modes.end(), [&](const Mode& mode) {
        return is_within(T_map_candidate_[i], query_.lattice.T_map_robot(mode.best.pose), distinct());
      });
      if (!known) found.modes.push_back(mode_at(i));
    }
    return found;
  }

 private:
  [[nodiscard]] PoseSpacing step() const {
    return {.translation_m = query_.lattice.step_cells * query_.lattice.resolution_m,
            .rotation_rad = query_.lattice.heading_step_rad()};
  }
  [[nodiscard]] PoseSpacing distinct() const {
    return {.translation_m = query_.options.distinct_translation_m,
            .rotation_rad = query_.options.distinct_rotation_rad};
  }
  static bool is_within(const Pose2& a, const Pose2& b, const PoseSpacing& distances) {
    return translation_distance(a, b) < distances.translation_m &&
           angle_distance(a.theta_rad, b.theta_rad) < distances.rotation_rad;
  }

  // Casts the scan's beams from every pose.
  std::vector<double> log_likelihoods(const std::vector<Pose2>& T_map_robot, const PoseSpacing& spacing) {
    std::vector<double> answers(T_map_robot.size());
    const std::size_t beams = model_.beams().size();
    parallel_for((T_map_robot.size() + poses_per_task - 1) / poses_per_task, query_.threads,
                 [&](std::size_t task) {
                   const std::size_t first = task * poses_per_task;
                   const std::size_t last = std::min(first + poses_per_task, T_map_robot.size());
                   std::vector<raycast::Pose> poses;
                   for (std::size_t i = first; i < last; ++i) poses.push_back(to_raycast(T_map_robot[i]));
                   std::vector<float> simulated_m(poses.size() * beams);
                   query_.map.scene().cast_fans(poses, model_.beams(), simulated_m);
                   for (std::size_t i = first; i < last; ++i)
                     answers[i] = model_.log_likelihood(
                         T_map_robot[i],
                         std::span<const float>(simulated_m).subspan((i - first) * beams, beams), spacing);
                 });
    rays_cast_ += static_cast<std::int64_t>(T_map_robot.size() * beams);
    return answers;
  }

  // Where ranges say little of any pose, as sonars' do that walls reflect away, the score decides: it asks
  // less of a map.
  [[nodiscard]] double log_likelihood(double log_ranges, const Candidate& candidate) const {
    const double behind = 1.0 - static_cast<double>(candidate.score) / best_score_;
    return log_add(log_ranges, log_elsewhere_ - score_nats * behind);
  }

  // Poses a few cells apart are alike in score: those compared are of the neighbourhoods whose best score's
  // ranges are the likeliest, so that no single place takes all of them. In the order of scores.
  void choose_candidates(const std::vector<Candidate>& all) {
    std::vector<bool> chosen(all.size(), false);
    std::size_t left = most_compared;
    for (std::size_t i = 0; in_order_ && i < std::min(most_in_order, all.size()); ++i, --left)
      chosen[i] = true;
    for (const Neighbourhood& place : likeliest_places(all)) {
      for (const std::size_t i : place) {
        if (left == 0) break;
        if (chosen[i]) continue;
        chosen[i] = true;
        --left;
      }
    }
    for (std::size_t i = 0; i < all.size(); ++i)
      if (chosen[i]) candidates_.push_back(all[i]);
  }

  // The likeliest by the ranges at its best score first.
  std::vector<Neighbourhood> likeliest_places(const std::vector<Candidate>& all) {
    std::vector<Neighbourhood> places = neighbourhoods(query_, all, most_neighbourhoods, most_members);
    std::vector<Pose2> T_map_best;
    T_map_best.reserve(places.size());
    for (const Neighbourhood& place : places)
      T_map_best.push_back(query_.lattice.T_map_robot(all[place.front()].pose));
    constexpr double steps = 3.0;  // the likeliest pose may be so far from the best score
    std::vector<double> log_place = log_likelihoods(
        T_map_best, {.translation_m = steps * step().translation_m, .rotation_rad = step().rotation_rad});
    for (std::size_t p = 0; p < places.size(); ++p)
      log_place[p] = log_likelihood(log_place[p], all[places[p].front()]);
    std::vector<std::size_t> order(places.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return log_place[a] > log_place[b]; });
    std::vector<Neighbourhood> sorted;
    sorted.reserve(places.size());
    for (const std::size_t place : order) sorted.push_back(std::move(places[place]));
    return sorted;
  }

  void weigh_lattice() {
    log_mass_ = log_likelihoods(T_map_candidate_, step());
    for (std::size_t i = 0; i < candidates_.size(); ++i)
      log_mass_[i] = log_likelihood(log_mass_[i], candidates_[i]) +
                     query_.domain.log_prior(query_.lattice, candidates_[i].pose);
    for (std::size_t i = 0; i < candidates_.size(); ++i) by_mass_.push_back(i);
    std::stable_sort(by_mass_.begin(), by_mass_.end(),
                     [this](std::size_t a, std::size_t b) { return log_mass_[a] > log_mass_[b]; });
  }

  // The likeliest poses by those within their cells.
  void refine() {
    const double least = log_mass_[by_mass_.front()] - least_refined_nats;
    std::vector<Pose2> T_map_robot;
    for (const std::size_t i : by_mass_) {
      if (refined_ >= most_refined || log_mass_[i] < least) break;
      ++refined_;
      const std::vector<Pose2> within = poses_within_cell(query_.lattice, T_map_candidate_[i]);
      T_map_robot.insert(T_map_robot.end(), within.begin(), within.end());
    }
    const std::vector<double> log_ranges = log_likelihoods(
        T_map_robot,
        {.translation_m = 0.5 * step().translation_m, .rotation_rad = 0.5 * step().rotation_rad});
    constexpr std::size_t within_cell = 8;
    for (std::size_t s = 0; s < T_map_robot.size(); ++s) {
      const std::size_t i = by_mass_[s / within_cell];
      const double log_prior = query_.domain.log_prior(query_.lattice, candidates_[i].pose);
      samples_.push_back({T_map_robot[s],
                          log_likelihood(log_ranges[s], candidates_[i]) + log_prior - std::log(within_cell),
                          i});
    }
    for (std::size_t k = refined_; k < by_mass_.size(); ++k)
      samples_.push_back({T_map_candidate_[by_mass_[k]], log_mass_[by_mass_[k]], by_mass_[k]});
    for (const Sample& sample : samples_) log_best_ = std::max(log_best_, sample.log_mass);
    for (const Sample& sample : samples_) all_ += mass(sample);
  }

  [[nodiscard]] double mass(const Sample& sample) const { return std::exp(sample.log_mass - log_best_); }

  // Poses by what lies around them: of the refined ones; the others follow by what they weigh themselves.
  void find_centres() {
    if (in_order_) {
      for (std::size_t i = 0; i < candidates_.size(); ++i) centres_.push_back({i, 0.0});
      return;
    }
    const PoseSpacing near{.translation_m = 1.01 * step().translation_m,
                           .rotation_rad = 1.4 * step().rotation_rad};
    for (std::size_t k = 0; k < refined_; ++k) {
      Centre centre{.candidate = by_mass_[k], .mass = 0.0};
      for (const Sample& sample : samples_)
        if (is_within(sample.T_map_robot, T_map_candidate_[centre.candidate], near))
          centre.mass += mass(sample);
      centres_.push_back(centre);
    }
    std::stable_sort(centres_.begin(), centres_.end(),
                     [](const Centre& a, const Centre& b) { return a.mass > b.mass; });
    for (std::size_t k = refined_; k < by_mass_.size(); ++k) centres_.push_back({by_mass_[k], 0.0});
  }

  // Takes what is within the distinct distances.
  Mode mode_at(std::size_t candidate) {
    Mode mode;
    mode.best = candidates_[candidate];
    double total = 0.0;
    Pose2 mean{0.0, 0.0, 0.0};
    const Pose2& T_map_mode = T_map_candidate_[candidate];
    for (Sample& sample : samples_) {
      if (sample.taken || !is_within(sample.T_map_robot, T_map_mode, distinct())) continue;
      sample.taken = true;
      const double one = mass(sample);
      total += one;
      mean.x_m += one * (sample.T_map_robot.x_m - T_map_mode.x_m);
      mean.y_m += one * (sample.T_map_robot.y_m - T_map_mode.y_m);
      mean.theta_rad += one * wrap_angle(sample.T_map_robot.theta_rad - T_map_mode.theta_rad);
    }
    mode.log_mass = total > 0.0 ? log_best_ + std::log(total) : nothing;
    mode.T_map_mean = T_map_mode;
    if (total > 0.0)
      mode.T_map_mean = {T_map_mode.x_m + mean.x_m / total, T_map_mode.y_m + mean.y_m / total,
                         wrap_angle(T_map_mode.theta_rad + mean.theta_rad / total)};
    return mode;
  }

  const Query& query_;
  BeamModel model_;
  bool in_order_;  // of scores
  double log_elsewhere_ = 0.0;
  std::int32_t best_score_ = 1;
  std::vector<Candidate> candidates_;
  std::vector<Pose2> T_map_candidate_;
  std::vector<double> log_mass_;  // of each candidate, by the lattice's pose
  std::vector<std::size_t> by_mass_;
  std::size_t refined_ = 0;
  std::vector<Sample> samples_;
  double log_best_ = nothing;
  double all_ = 0.0;  // over exp(log_best_)
  std::vector<Centre> centres_;
  std::int64_t rays_cast_ = 0;
};

}  // namespace

Modes find_modes_by_ranges(const Query& query, const Proposal& proposal, std::size_t most) {
  if (proposal.candidates.empty()) return {};
  return RangePosterior(query, proposal).modes(most);
}

}  // namespace landfall::internal
