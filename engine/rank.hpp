// Distinct modes in order, what they share of the posterior, and the verdict.
#pragma once

#include <vector>

#include "engine/query.hpp"
#include "engine/verify.hpp"

namespace landfall::internal {

// A peak of the score and all candidates nearer to it than to any better peak.
struct Mode {
  Candidate best;
  double log_mass = 0.0;  // prior x likelihood, summed over its candidates; natural logarithm
  double share = 0.0;     // of the best imaginable score, at the refined pose
  int map_index = 0;
  Verification verification;
  Hypothesis hypothesis;  // filled in by refine and verify
};

// What one map has to say of one scan.
struct Modes {
  std::vector<Mode> modes;  // best score first
  double log_rest = 0.0;    // mass of the candidates beyond the last mode
  double nats = 0.0;        // what a share of 1 is worth
  std::size_t points = 0;
};

// Greedy: the best candidate is a mode; each next one joins the first mode within both distances, or
// becomes one. At most `most` modes.
Modes find_modes(const Query& query, const std::vector<Candidate>& candidates, std::size_t most);

// Verified modes of all maps -> hypotheses in order, probabilities, verdict.
void rank(const std::vector<Modes>& maps, int max_hypotheses, SearchResult& result);

}  // namespace landfall::internal
