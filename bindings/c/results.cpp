#include "bindings/c/handles.hpp"

namespace {

using landfall::c::guarded;
using landfall::c::required;

landfall_verdict to_c(landfall::Verdict verdict) {
  switch (verdict) {
    case landfall::Verdict::found:
      return LANDFALL_FOUND;
    case landfall::Verdict::ambiguous:
      return LANDFALL_AMBIGUOUS;
    case landfall::Verdict::lost:
      break;
  }
  return LANDFALL_LOST;
}

landfall_result view_of(const landfall::SearchResult& result,
                        std::span<const landfall_hypothesis> hypotheses) {
  return {.verdict = to_c(result.verdict),
          .proven = result.proven ? 1 : 0,
          .hypotheses = hypotheses.data(),
          .hypothesis_count = hypotheses.size(),
          .reason = result.reason.c_str(),
          .method = result.method.c_str(),
          .stamp_s = result.stamp_s,
          .beams_valid = result.beams_valid,
          .beams_echo = result.beams_echo,
          .poses_covered = result.counts.poses_covered,
          .poses_scored = result.counts.poses_scored,
          .bounds_computed = result.counts.bounds_computed,
          .rays_cast = result.counts.rays_cast,
          .prepare_ms = result.times.prepare_ms,
          .propose_ms = result.times.propose_ms,
          .refine_ms = result.times.refine_ms,
          .verify_ms = result.times.verify_ms,
          .rank_ms = result.times.rank_ms,
          .total_ms = result.times.total_ms};
}

}  // namespace

size_t landfall_results_count(const landfall_results* results) {
  return results == nullptr ? 0 : results->results.size();
}

landfall_status landfall_results_get(const landfall_results* results, size_t index, landfall_result* result) {
  return guarded(__func__, [&] {
    const landfall_results& all = required(results, "results");
    if (index >= all.results.size())
      landfall::c::refuse("index is " + std::to_string(index) + ", there are " +
                          std::to_string(all.results.size()) + " results");
    required(result, "result") = view_of(all.results[index], all.hypotheses[index]);
  });
}

void landfall_results_free(landfall_results* results) {
  delete results;
}
