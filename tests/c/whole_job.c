/* From nothing to a pose: a drawn map, a sensor, a simulated scan, every kind of prior, a search. */
#include <math.h>
#include <string.h>

#include "drawn_room.h"

static const landfall_pose TRUTH = {2.468, 3.554, 0.6};

static void check_pose(const landfall_results* results, size_t index) {
  landfall_result result;
  CHECK_OK(landfall_results_get(results, index, &result));
  CHECK(result.hypothesis_count >= 1 && result.hypothesis_count <= 5);
  const landfall_hypothesis* best = &result.hypotheses[0];
  CHECK(hypot(best->T_map_robot.x_m - TRUTH.x_m, best->T_map_robot.y_m - TRUTH.y_m) < 0.05);
  CHECK(fabs(best->T_map_robot.theta_rad - TRUTH.theta_rad) < 0.02);
  CHECK(best->explained > 0.9 && best->explained <= 1.0);
  CHECK(best->map_index == 0 && best->score > 0);
  CHECK(result.proven == 1);
  CHECK(result.beams_valid == 360 && result.total_ms > 0.0);
  CHECK(strlen(result.method) > 0 && strcmp(result.reason, "") == 0);
}

/* The exact ranges of the truth, put together as a log would be. */
static landfall_scans* simulate_scan(const landfall_map* map, const landfall_sensor* scanner) {
  float ranges_m[360];
  CHECK(landfall_sensor_beam_count(scanner) == 360);
  CHECK_OK(landfall_simulate_ranges(map, scanner, &TRUTH, 1, ranges_m, 360));
  landfall_scans* scans = NULL;
  CHECK_OK(landfall_scans_new(&scans));
  CHECK_OK(landfall_scans_add(scans, scanner, ranges_m, 360, 12.5, NULL));
  CHECK_OK(landfall_simulate(map, scanner, &TRUTH, 1, 7, scans));
  CHECK(landfall_scans_count(scans) == 2);
  return scans;
}

static void search_under(landfall_prior* prior, const landfall_map* map, const landfall_scans* scans) {
  landfall_results* results = NULL;
  CHECK_OK(landfall_search(map, prior, scans, NULL, &results));
  CHECK(landfall_results_count(results) == 2);
  check_pose(results, 0);
  check_pose(results, 1);
  landfall_results_free(results);
  landfall_prior_free(prior);
}

static void search_under_every_prior(const landfall_map* map, const landfall_scans* scans) {
  const double covariance[9] = {0.04, 0.0, 0.0, 0.0, 0.04, 0.0, 0.0, 0.0, 0.01};
  const landfall_pose near_truth = {2.4, 3.6, 0.5};
  const landfall_point corners[4] = {{0.4, 3.0}, {3.6, 3.0}, {3.6, 4.4}, {0.4, 4.4}};
  const landfall_point beacon = {2.0, 3.2};
  const double radius_m = 1.0;
  landfall_prior* prior = NULL;
  CHECK_OK(landfall_prior_anywhere(&prior));
  search_under(prior, map, scans);
  CHECK_OK(landfall_prior_window(near_truth, 0.3, 0.3, 0.4, &prior));
  search_under(prior, map, scans);
  CHECK_OK(landfall_prior_gaussian(near_truth, covariance, &prior));
  search_under(prior, map, scans);
  CHECK_OK(landfall_prior_region(corners, 4, 0.0, 3.14159265358979, &prior));
  search_under(prior, map, scans);
  CHECK_OK(landfall_prior_beacons(&beacon, &radius_m, 1, &prior));
  search_under(prior, map, scans);
  const landfall_pose candidates[2] = {{6.0, 1.0, -2.0}, TRUTH};
  CHECK_OK(landfall_prior_poses(candidates, 2, &prior));
  search_under(prior, map, scans);
}

static void search_under_a_mixture_of_two_maps(const landfall_map* map, const landfall_scans* scans) {
  landfall_prior* components[2] = {NULL, NULL};
  const double weights[2] = {0.9, 0.1};
  CHECK_OK(landfall_prior_window(TRUTH, 0.2, 0.2, 0.2, &components[0]));
  CHECK_OK(landfall_prior_anywhere(&components[1]));
  landfall_prior* mixture = NULL;
  CHECK_OK(landfall_prior_mixture((const landfall_prior* const*)components, weights, 2, &mixture));

  const landfall_wall walls[3] = {{{0, 0}, {5, 0}}, {{5, 0}, {5, 5}}, {{5, 5}, {0, 0}}};
  landfall_map* triangle = NULL;
  CHECK_OK(landfall_map_from_walls(walls, 3, 0.1, &triangle));
  const landfall_map* maps[2] = {map, triangle};
  const landfall_prior* priors[1] = {mixture};
  landfall_search_options options;
  landfall_search_options_init(&options);
  options.method = "branch_and_bound";
  options.threads = 1;
  landfall_results* results = NULL;
  CHECK_OK(landfall_search_maps(maps, 2, priors, 1, scans, &options, &results));
  check_pose(results, 0);
  landfall_result result;
  CHECK_OK(landfall_results_get(results, 0, &result));
  CHECK(result.verdict == LANDFALL_FOUND && result.hypotheses[0].map_index == 0);

  landfall_results_free(results);
  landfall_map_free(triangle);
  landfall_prior_free(mixture);
  landfall_prior_free(components[1]);
  landfall_prior_free(components[0]);
}

/* The method's own pose, which follows from the seed and from nothing else. */
static landfall_pose search_by(const char* method, uint64_t seed, const landfall_map* map,
                               const landfall_scans* scans) {
  landfall_search_options options;
  landfall_search_options_init(&options);
  options.method = method;
  options.seed = seed;
  landfall_prior* prior = NULL;
  const landfall_pose near_truth = {2.45, 3.56, 0.58};
  const double half_m = strcmp(method, "sdn") == 0 ? 0.1 : 1.0; /* sdn is for small windows */
  CHECK_OK(landfall_prior_window(near_truth, half_m, half_m, half_m, &prior));
  landfall_results* results = NULL;
  CHECK_OK(landfall_search(map, prior, scans, &options, &results));
  landfall_result result;
  CHECK_OK(landfall_results_get(results, 0, &result));
  CHECK(strncmp(result.method, method, strlen(method)) == 0);
  CHECK(result.hypothesis_count >= 1 && result.verdict == LANDFALL_FOUND);
  const landfall_hypothesis best = result.hypotheses[0];
  CHECK(hypot(best.T_map_robot.x_m - TRUTH.x_m, best.T_map_robot.y_m - TRUTH.y_m) < 0.05);
  CHECK(fabs(best.T_map_robot.theta_rad - TRUTH.theta_rad) < 0.035); /* 5 cm at 1.5 m */
  CHECK(result.proven == 0 && result.rays_cast > 0);
  landfall_results_free(results);
  landfall_prior_free(prior);
  return best.T_map_robot_unrefined;
}

static void search_by_diffusion(const landfall_map* map, const landfall_scans* scans) {
  const char* const methods[2] = {"sdn", "fsdn"};
  for (int i = 0; i < 2; ++i) {
    const landfall_pose one = search_by(methods[i], 1, map, scans);
    const landfall_pose again = search_by(methods[i], 1, map, scans);
    const landfall_pose other = search_by(methods[i], 2, map, scans);
    CHECK(one.x_m == again.x_m && one.y_m == again.y_m && one.theta_rad == again.theta_rad);
    CHECK(one.x_m != other.x_m || one.y_m != other.y_m);
  }
}

/* A stop that was asked for before the search ends it at once; one that was not changes nothing. */
static void search_with_a_stop(const landfall_map* map, const landfall_scans* scans) {
  landfall_prior* prior = NULL;
  landfall_stop* stop = NULL;
  landfall_results* results = NULL;
  landfall_result result;
  landfall_search_options options;
  landfall_search_options_init(&options);
  CHECK(options.stop == NULL);
  CHECK_OK(landfall_stop_new(&stop));
  CHECK_OK(landfall_prior_anywhere(&prior));
  options.stop = stop;
  CHECK_OK(landfall_search(map, prior, scans, &options, &results));
  check_pose(results, 0);
  landfall_results_free(results);

  CHECK_OK(landfall_stop_request(stop));
  CHECK_OK(landfall_search(map, prior, scans, &options, &results));
  CHECK(landfall_results_count(results) == 2);
  CHECK_OK(landfall_results_get(results, 1, &result));
  CHECK(result.verdict == LANDFALL_LOST && result.hypothesis_count == 0 && result.proven == 0);
  CHECK(strcmp(result.reason, "stopped before any pose was scored") == 0);
  landfall_results_free(results);
  landfall_stop_free(stop);
  landfall_stop_free(NULL);
  landfall_prior_free(prior);
}

static void list_methods(void) {
  int found = 0;
  for (size_t i = 0; i < landfall_method_count(); ++i) {
    landfall_method method;
    CHECK_OK(landfall_method_get(i, &method));
    CHECK(strlen(method.summary) > 0 && method.source != NULL);
    found += strcmp(method.name, "branch_and_bound") == 0;
  }
  CHECK(found == 1);
  const char* isa = NULL;
  CHECK_OK(landfall_active_isa(&isa));
  CHECK(strlen(isa) > 0);
  const char* executor = NULL;
  CHECK_OK(landfall_active_executor(&executor));
  CHECK(strlen(executor) > 0);
  CHECK(strncmp(landfall_version(), "0.", 2) == 0);
}

int main(void) {
  landfall_map* map = make_room();
  CHECK_OK(landfall_map_prepare(map));
  landfall_sensor* scanner = make_scanner();
  landfall_scans* scans = simulate_scan(map, scanner);
  const char* ray_caster = NULL;
  CHECK_OK(landfall_ray_caster(map, scanner, &ray_caster));
  CHECK(strcmp(ray_caster, "distance_walk") == 0);
  landfall_sensor_free(scanner); /* the scans keep it alive */
  search_under_every_prior(map, scans);
  search_under_a_mixture_of_two_maps(map, scans);
  search_by_diffusion(map, scans);
  search_with_a_stop(map, scans);
  list_methods();
  landfall_scans_free(scans);
  landfall_map_free(map);
  return 0;
}
