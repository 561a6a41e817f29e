// Distinct modes in order, what they share of the posterior, and the verdict.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "engine/query.hpp"
#include "engine/verify/verify.hpp"

namespace landfall::internal {

// A pose that explains less than this is none.
inline constexpr double least_explained = 0.5;

// A peak of the score. All peaks are taken to be equally wide, so that the likelihood at the top stands for
// the mass: sums over the lattice favoured blurred matches over sharp ones (intel: five queries of 455).
struct Mode {
  Candidate best;
  std::optional<FreeCandidate> free;  // the method's own pose, where it is not the lattice's
  double log_prior = 0.0;
  double share = 0.0;         // of the best imaginable score, at the refined pose
  double log_mass = 0.0;      // prior x likelihood, of modes by ranges
  double log_readings = 0.0;  // of readings that the scan was condensed from (judge_by_readings.hpp)
  Pose2 T_map_mean;           // over that mass
  int map_index = 0;
  Verification verification;
  std::vector<std::vector<Pose2>> ways_to_settle;  // of a composite whose relative poses may be off
  Hypothesis hypothesis;                           // filled in by refine and verify
};

// What one map has to say of one scan.
struct Modes {
  std::vector<Mode> modes;    // best score first
  double log_rest = 0.0;      // mass of the modes beyond the last one: prior x likelihood
  double missed_share = 0.0;  // that a coarse lattice hides of the best pose's share
  std::size_t points = 0;
  bool by_ranges = false;      // modes weigh what range_posterior.hpp says, not what their scores do
  bool in_order = false;       // whatever they weigh, the first is the answer
  double log_all = 0.0;        // by ranges: of all poses of the prior
  double log_elsewhere = 0.0;  // by ranges: likelihood of the scan from a place off the map
  std::int64_t rays_cast = 0;  // by ranges: to find them
};

// Greedy: the best candidate is a mode, and so is each next one that is not within both distances of one
// before it. The first `most` are kept. Of scores that are the field's; free_candidates: see Proposal.
Modes find_modes(const Query& query, const std::vector<Candidate>& candidates, std::size_t most,
                 std::span<const FreeCandidate> free_candidates = {});

// Of modes that are one when refined only the first stays. Modes of lattices are not refined that far.
void drop_repeated(const SearchOptions& options, std::vector<Mode>& modes);

// Verified modes of all maps -> hypotheses in order, probabilities, verdict.
void rank(const std::vector<Modes>& maps, int max_hypotheses, SearchResult& result);

}  // namespace landfall::internal
