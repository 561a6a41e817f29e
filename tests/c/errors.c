/* Every refusal gives its code and a message that names the fault, and leaves the outputs alone. */
#include <math.h>
#include <string.h>

#include "drawn_room.h"

#define CHECK_FAILS(call, status, part)                   \
  do {                                                    \
    CHECK((call) == (status));                            \
    CHECK(strstr(landfall_last_error(), (part)) != NULL); \
  } while (0)

static void bad_maps(void) {
  uint8_t cells[4] = {0, 1, 2, 7};
  landfall_grid grid = {2, 2, 0.1, {0.0, 0.0, 0.0}, cells};
  landfall_map* map = NULL;
  CHECK_FAILS(landfall_map_from_grid(&grid, &map), LANDFALL_INVALID_ARGUMENT, "cells[3] is 7");
  cells[3] = 0;
  grid.resolution_m = -1.0;
  CHECK_FAILS(landfall_map_from_grid(&grid, &map), LANDFALL_INVALID_ARGUMENT, "resolution_m");
  grid.width_cells = 100000;
  grid.height_cells = 100000;
  CHECK_FAILS(landfall_map_from_grid(&grid, &map), LANDFALL_TOO_LARGE, "100000 x 100000");
  grid.width_cells = 0;
  CHECK_FAILS(landfall_map_from_grid(&grid, &map), LANDFALL_INVALID_ARGUMENT, "0 x 100000");
  CHECK_FAILS(landfall_map_from_grid(NULL, &map), LANDFALL_INVALID_ARGUMENT, "grid is NULL");
  CHECK_FAILS(landfall_map_from_walls(NULL, 0, 0.1, &map), LANDFALL_INVALID_ARGUMENT, "walls");
  CHECK_FAILS(landfall_map_load("no/such.yaml", &map), LANDFALL_FILE_NOT_FOUND, "no/such.yaml");
  CHECK_FAILS(landfall_map_load(NULL, &map), LANDFALL_INVALID_ARGUMENT, "path is NULL");
  CHECK(map == NULL);
  landfall_map_free(map);
}

static void bad_sensors(void) {
  landfall_sensor* sensor = NULL;
  landfall_fan_options fan;
  landfall_fan_options_init(&fan);
  fan.beam_count = 0;
  CHECK_FAILS(landfall_sensor_fan(&fan, &sensor), LANDFALL_INVALID_ARGUMENT, "beams");
  landfall_fan_options_init(&fan);
  fan.struct_size = 100000;
  CHECK_FAILS(landfall_sensor_fan(&fan, &sensor), LANDFALL_INVALID_ARGUMENT, "struct_size is 100000");
  landfall_beam beam = {{0.0, 0.0, 0.0}, 0.0, 2.0, 1.0};
  CHECK_FAILS(landfall_sensor_from_beams(&beam, 1, 0.01, 0.0, &sensor), LANDFALL_INVALID_ARGUMENT, "range_m");
  CHECK_FAILS(landfall_sensor_from_beams(NULL, 1, 0.01, 0.0, &sensor), LANDFALL_INVALID_ARGUMENT,
              "beams is NULL");
  CHECK(sensor == NULL);
}

static void bad_scans(const landfall_sensor* scanner) {
  landfall_scans* scans = NULL;
  CHECK_OK(landfall_scans_new(&scans));
  float ranges_m[360] = {0};
  CHECK_FAILS(landfall_scans_add(scans, scanner, ranges_m, 359, 0.0, NULL), LANDFALL_INVALID_ARGUMENT, "359");
  CHECK_FAILS(landfall_scans_add(scans, NULL, ranges_m, 360, 0.0, NULL), LANDFALL_INVALID_ARGUMENT,
              "sensor is NULL");
  CHECK(landfall_scans_count(scans) == 0);
  CHECK_OK(landfall_scans_add(scans, scanner, ranges_m, 360, 0.0, NULL));
  landfall_scan scan;
  CHECK_FAILS(landfall_scans_get(scans, 1, &scan), LANDFALL_INVALID_ARGUMENT, "the list has 1");
  CHECK_FAILS(landfall_scans_merge(scans, 0, 1, NULL, 0, scans), LANDFALL_INVALID_ARGUMENT,
              "no T_odom_robot");
  CHECK_FAILS(landfall_scans_merge(scans, 0, 1, NULL, 1, scans), LANDFALL_INVALID_ARGUMENT, "reference is 1");
  CHECK_FAILS(landfall_scans_merge(scans, 0, (size_t)-1, NULL, 0, scans), LANDFALL_INVALID_ARGUMENT,
              "the list has 1");
  CHECK(landfall_scans_count(scans) == 1);
  landfall_scans_free(scans);
}

static void bad_priors(void) {
  const landfall_pose origin = {0.0, 0.0, 0.0};
  const landfall_pose nowhere = {NAN, 0.0, 0.0};
  const landfall_point line[2] = {{0.0, 0.0}, {1.0, 0.0}};
  landfall_prior* prior = NULL;
  CHECK_FAILS(landfall_prior_window(origin, -1.0, 1.0, 1.0, &prior), LANDFALL_INVALID_ARGUMENT, "half_x_m");
  CHECK_FAILS(landfall_prior_poses(&nowhere, 1, &prior), LANDFALL_INVALID_ARGUMENT, "landfall_prior_poses");
  CHECK_FAILS(landfall_prior_region(line, 2, 0.0, 1.0, &prior), LANDFALL_INVALID_ARGUMENT, "polygon");
  CHECK_FAILS(landfall_prior_gaussian(origin, NULL, &prior), LANDFALL_INVALID_ARGUMENT, "covariance is NULL");
  CHECK_FAILS(landfall_prior_mixture(NULL, NULL, 0, &prior), LANDFALL_INVALID_ARGUMENT, "mixture");
  CHECK_FAILS(landfall_prior_anywhere(NULL), LANDFALL_INVALID_ARGUMENT, "prior is NULL");
  CHECK(prior == NULL);
}

static void bad_searches(const landfall_map* map, const landfall_sensor* scanner) {
  landfall_scans* scans = NULL;
  landfall_prior* anywhere = NULL;
  landfall_results* results = NULL;
  const landfall_pose pose = {1.0, 1.2, 0.0};
  CHECK_OK(landfall_scans_new(&scans));
  CHECK_OK(landfall_simulate(map, scanner, &pose, 1, 0, scans));
  CHECK_OK(landfall_prior_anywhere(&anywhere));
  landfall_search_options options;
  landfall_search_options_init(&options);
  options.method = "sorcery";
  CHECK_FAILS(landfall_search(map, anywhere, scans, &options, &results), LANDFALL_UNKNOWN_NAME, "sorcery");
  options.method = NULL;
  CHECK_FAILS(landfall_search(map, anywhere, scans, &options, &results), LANDFALL_INVALID_ARGUMENT,
              "method is NULL");
  CHECK_FAILS(landfall_search(NULL, anywhere, scans, NULL, &results), LANDFALL_INVALID_ARGUMENT,
              "map is NULL");
  CHECK_FAILS(landfall_search(map, anywhere, scans, NULL, NULL), LANDFALL_INVALID_ARGUMENT,
              "results is NULL");
  CHECK_FAILS(landfall_simulate_ranges(map, scanner, &pose, 1, NULL, 359), LANDFALL_INVALID_ARGUMENT,
              "range_count is 359");

  landfall_prior* elsewhere = NULL;
  const landfall_pose far_away = {500.0, 500.0, 0.0};
  CHECK_OK(landfall_prior_window(far_away, 1.0, 1.0, 1.0, &elsewhere));
  CHECK_FAILS(landfall_search(map, elsewhere, scans, NULL, &results), LANDFALL_INVALID_ARGUMENT,
              "landfall_search");
  CHECK(results == NULL);
  landfall_prior_free(elsewhere);
  landfall_prior_free(anywhere);
  landfall_scans_free(scans);
}

/* A scan without a valid beam is answered: lost, with the reason. */
static void nothing_to_go_by(const landfall_map* map, const landfall_sensor* scanner) {
  float ranges_m[360];
  for (int i = 0; i < 360; ++i) ranges_m[i] = NAN;
  landfall_scans* scans = NULL;
  landfall_prior* anywhere = NULL;
  landfall_results* results = NULL;
  CHECK_OK(landfall_scans_new(&scans));
  CHECK_OK(landfall_scans_add(scans, scanner, ranges_m, 360, 0.0, NULL));
  CHECK_OK(landfall_prior_anywhere(&anywhere));
  CHECK_OK(landfall_search(map, anywhere, scans, NULL, &results));
  landfall_result result;
  CHECK_OK(landfall_results_get(results, 0, &result));
  CHECK(result.verdict == LANDFALL_LOST && result.hypothesis_count == 0 && strlen(result.reason) > 0);
  CHECK_FAILS(landfall_results_get(results, 1, &result), LANDFALL_INVALID_ARGUMENT, "there are 1");
  landfall_results_free(results);
  landfall_prior_free(anywhere);
  landfall_scans_free(scans);
}

int main(void) {
  CHECK(strcmp(landfall_last_error(), "") == 0);
  landfall_map* map = make_room();
  landfall_sensor* scanner = make_scanner();
  bad_maps();
  bad_sensors();
  bad_scans(scanner);
  bad_priors();
  bad_searches(map, scanner);
  nothing_to_go_by(map, scanner);
  landfall_method method;
  CHECK_FAILS(landfall_method_get(1000, &method), LANDFALL_INVALID_ARGUMENT, "index is 1000");
  const char* ray_caster = NULL;
  CHECK_FAILS(landfall_ray_caster(NULL, scanner, &ray_caster), LANDFALL_INVALID_ARGUMENT, "map is NULL");
  CHECK_FAILS(landfall_ray_caster(map, NULL, &ray_caster), LANDFALL_INVALID_ARGUMENT, "sensor is NULL");
  CHECK_FAILS(landfall_ray_caster(map, scanner, NULL), LANDFALL_INVALID_ARGUMENT, "ray_caster is NULL");
  CHECK(ray_caster == NULL);
  landfall_sensor_free(scanner);
  landfall_map_free(map);
  return 0;
}
