#include "landfall/search.hpp"

#include <algorithm>

#include "bindings/c/handles.hpp"

namespace {

using landfall::c::array;
using landfall::c::guarded;
using landfall::c::required;
using landfall::c::to_c;

landfall::SearchOptions search_options(const landfall_search_options* given) {
  const landfall_search_options options = landfall::c::or_defaults(given, landfall_search_options_init);
  return {.method = &required(options.method, "options.method"),
          .translation_step_m = options.translation_step_m,
          .rotation_step_rad = options.rotation_step_rad,
          .max_hypotheses = options.max_hypotheses,
          .time_budget_s = options.time_budget_s,
          .threads = options.threads,
          .seed = options.seed,
          .robot_radius_m = options.robot_radius_m,
          .distinct_translation_m = options.distinct_translation_m,
          .distinct_rotation_rad = options.distinct_rotation_rad,
          .stop = options.stop == nullptr ? std::stop_token() : options.stop->source.get_token()};
}

landfall_hypothesis hypothesis_to_c(const landfall::Hypothesis& source) {
  landfall_hypothesis hypothesis{.T_map_robot = to_c(source.T_map_robot),
                                 .T_map_robot_unrefined = to_c(source.T_map_robot_unrefined),
                                 .score = source.score,
                                 .explained = source.explained,
                                 .probability = source.probability,
                                 .covariance = {},
                                 .map_index = source.map_index};
  std::copy(source.covariance.begin(), source.covariance.end(), hypothesis.covariance);
  return hypothesis;
}

landfall_results* make_handle(std::vector<landfall::SearchResult> found) {
  auto results = std::make_unique<landfall_results>();
  results->results = std::move(found);
  for (const landfall::SearchResult& result : results->results) {
    auto& hypotheses = results->hypotheses.emplace_back();
    for (const landfall::Hypothesis& hypothesis : result.hypotheses)
      hypotheses.push_back(hypothesis_to_c(hypothesis));
  }
  return results.release();
}

}  // namespace

void landfall_search_options_init(landfall_search_options* options) {
  if (options == nullptr) return;
  const landfall::SearchOptions defaults;
  *options = {.struct_size = sizeof(landfall_search_options),
              .method = "auto",
              .translation_step_m = defaults.translation_step_m,
              .rotation_step_rad = defaults.rotation_step_rad,
              .max_hypotheses = defaults.max_hypotheses,
              .threads = defaults.threads,
              .time_budget_s = defaults.time_budget_s,
              .seed = defaults.seed,
              .robot_radius_m = defaults.robot_radius_m,
              .distinct_translation_m = defaults.distinct_translation_m,
              .distinct_rotation_rad = defaults.distinct_rotation_rad,
              .stop = nullptr};
}

landfall_status landfall_stop_new(landfall_stop** stop) {
  return guarded(__func__, [&] { required(stop, "stop") = new landfall_stop; });
}

landfall_status landfall_stop_request(landfall_stop* stop) {
  return guarded(__func__, [&] { required(stop, "stop").source.request_stop(); });
}

void landfall_stop_free(landfall_stop* stop) {
  delete stop;
}

landfall_status landfall_search(const landfall_map* map, const landfall_prior* prior,
                                const landfall_scans* scans, const landfall_search_options* options,
                                landfall_results** results) {
  return guarded(__func__, [&] {
    auto*& made = required(results, "results");
    made = make_handle(landfall::search(required(map, "map").map, required(prior, "prior").prior,
                                        required(scans, "scans").scans, search_options(options)));
  });
}

landfall_status landfall_search_maps(const landfall_map* const* maps, size_t map_count,
                                     const landfall_prior* const* priors, size_t prior_count,
                                     const landfall_scans* scans, const landfall_search_options* options,
                                     landfall_results** results) {
  return guarded(__func__, [&] {
    auto*& made = required(results, "results");
    std::vector<landfall::PreparedMap> given_maps;
    for (const landfall_map* map : array(maps, map_count, "maps"))
      given_maps.push_back(required(map, "a map").map);
    std::vector<landfall::PosePrior> given_priors;
    for (const landfall_prior* prior : array(priors, prior_count, "priors"))
      given_priors.push_back(required(prior, "a prior").prior);
    made = make_handle(
        landfall::search(given_maps, given_priors, required(scans, "scans").scans, search_options(options)));
  });
}
