// What a search method is asked, and what it answers.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "engine/evidence.hpp"
#include "engine/guess.hpp"
#include "engine/maps/prepared_state.hpp"
#include "engine/priors/domain.hpp"
#include "engine/priors/lattice.hpp"
#include "engine/scans/end_points.hpp"
#include "landfall/search.hpp"

namespace landfall::internal {

using Clock = std::chrono::steady_clock;

// When a budget that begins at `start` ends; none where it is 0, or longer than clocks count.
std::optional<Clock::time_point> deadline_of(Clock::time_point start, double time_budget_s);

struct Query {
  const PreparedState& map;
  const Scan& scan;
  const EndPoints& points;
  const Lattice& lattice;
  const Domain& domain;
  const SearchOptions& options;
  RivalMargin margin{};
  int threads = 1;
  std::optional<Clock::time_point> deadline;
  std::optional<Guess> guess{};  // on this map

  [[nodiscard]] bool out_of_time() const {
    return options.stop.stop_requested() || (deadline && Clock::now() >= *deadline);
  }
};

struct Candidate {
  LatticePose pose;
  std::int32_t score = 0;
};

// Better score first; equal ones by heading, row, column.
inline bool better(const Candidate& a, const Candidate& b) {
  return a.score != b.score ? a.score > b.score : a.pose < b.pose;
}

enum class Scores : std::uint8_t {
  field,       // sums of the likelihood field: they say how likely a pose is
  own,         // the method's: they propose poses, and ranges say how likely those are
  own_decide,  // the same, but hypotheses are in the order of scores
};

// A candidate of a method that is not bound to the lattice.
struct FreeCandidate {
  Pose2 T_map_robot;
  std::int64_t score = 0;  // the method's own, shown to users
};

struct Proposal {
  // The best pose of every block of 8 x 8 cells at every heading whose score is at least
  // lowest_rival(best score), best first: at most max_candidates. Empty: nothing scores.
  std::vector<Candidate> candidates;
  bool proven = false;
  SearchCounts counts;
  Scores scores = Scores::field;
  // Of a method that is not bound to the lattice, one for each of the candidates, which are then the lattice
  // poses nearest to them, scored by the field. Empty: candidates are lattice poses.
  std::vector<FreeCandidate> free_candidates;
  std::string way;  // which of its ways a method took, where it has several
};

inline constexpr std::size_t max_candidates = std::size_t{1} << 16;

// Poses that score less than this beside the best one cannot take a share of the probability that
// matters; methods need not look for them. At least 1. See evidence.hpp for what a score is worth.
std::int32_t lowest_rival(std::int32_t best_score, const RivalMargin& margin);

// Drops what lies below lowest_rival(best), sorts, cuts to max_candidates.
void keep_rivals(std::vector<Candidate>& candidates, const RivalMargin& margin);

// The best allowed pose of a block; score 0 where none scores.
Candidate best_of_block(const std::int32_t* scores, std::uint64_t allowed, int heading, int block_row,
                        int block_col);

}  // namespace landfall::internal
