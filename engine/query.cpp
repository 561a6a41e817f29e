#include "engine/query.hpp"

#include <algorithm>
#include <bit>

namespace landfall::internal {

std::optional<Clock::time_point> deadline_of(Clock::time_point start, double time_budget_s) {
  constexpr double longest_s = 1e9;  // 30 years
  if (!(time_budget_s > 0.0) || time_budget_s > longest_s) return std::nullopt;
  return start + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(time_budget_s));
}

std::int32_t lowest_rival(std::int32_t best_score, const RivalMargin& margin) {
  return std::max(1, best_score - margin.at(best_score));
}

void keep_rivals(std::vector<Candidate>& candidates, const RivalMargin& margin) {
  std::int32_t best = 0;
  for (const Candidate& candidate : candidates) best = std::max(best, candidate.score);
  const std::int32_t lowest = lowest_rival(best, margin);
  std::erase_if(candidates, [lowest](const Candidate& candidate) { return candidate.score < lowest; });
  if (candidates.size() > max_candidates) {
    std::nth_element(candidates.begin(), candidates.begin() + max_candidates, candidates.end(), better);
    candidates.resize(max_candidates);
  }
  std::sort(candidates.begin(), candidates.end(), better);
}

Candidate best_of_block(const std::int32_t* scores, std::uint64_t allowed, int heading, int block_row,
                        int block_col) {
  using kernels::block_cells;
  Candidate best;
  for (; allowed != 0; allowed &= allowed - 1) {
    const int bit = std::countr_zero(allowed);
    if (scores[bit] <= best.score) continue;
    best = {.pose = {.heading = heading,
                     .row = block_row * block_cells + bit / block_cells,
                     .col = block_col * block_cells + bit % block_cells},
            .score = scores[bit]};
  }
  return best;
}

}  // namespace landfall::internal
