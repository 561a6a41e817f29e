/* A robot with eight narrow sonars turns on the spot: the whole of method fft from C. */
#include <math.h>

#include "drawn_room.h"

enum { TURNS = 90, SONARS = 8 };
static const double PI = 3.14159265358979;
static const landfall_pose TRUTH = {2.468, 2.554, 0.6};

static landfall_sensor* make_sonars(void) {
  landfall_fan_options fan;
  landfall_fan_options_init(&fan);
  fan.beam_count = SONARS;
  fan.step_rad = 2.0 * PI / SONARS;
  fan.range_max_m = 5.0;
  landfall_sensor* sensor = NULL;
  CHECK_OK(landfall_sensor_fan(&fan, &sensor));
  return sensor;
}

int main(void) {
  landfall_map* map = make_room();
  landfall_sensor* sonars = make_sonars();
  landfall_pose turned[TURNS];
  for (int i = 0; i < TURNS; ++i) {
    turned[i] = TRUTH;
    turned[i].theta_rad += i * 2.0 * PI / TURNS;
  }
  landfall_scans* turn = NULL;
  landfall_scans* condensed = NULL;
  CHECK_OK(landfall_scans_new(&turn));
  CHECK_OK(landfall_scans_new(&condensed));
  CHECK_OK(landfall_simulate(map, sonars, turned, TURNS, 1, turn));
  CHECK(landfall_scans_merge_turn_minima(turn, 1, TURNS, condensed) == LANDFALL_INVALID_ARGUMENT);
  landfall_sensor* scanner = make_scanner();
  CHECK_OK(landfall_simulate(map, scanner, &TRUTH, 1, 1, turn)); /* another sensor's scan at the end */
  CHECK(landfall_scans_merge_turn_minima(turn, 1, TURNS, condensed) == LANDFALL_INVALID_ARGUMENT);
  CHECK(landfall_scans_count(condensed) == 0);
  CHECK_OK(landfall_scans_merge_turn_minima(turn, 0, TURNS, condensed));
  CHECK(landfall_scans_count(condensed) == 1);
  landfall_scan scan;
  CHECK_OK(landfall_scans_get(condensed, 0, &scan));
  CHECK(scan.range_count > 4 && scan.range_count < TURNS * SONARS);

  landfall_search_options options;
  landfall_search_options_init(&options);
  options.method = "fft";
  options.rotation_step_rad = PI / 32.0;
  landfall_prior* anywhere = NULL;
  CHECK_OK(landfall_prior_anywhere(&anywhere));
  landfall_results* results = NULL;
  CHECK_OK(landfall_search(map, anywhere, condensed, &options, &results));
  landfall_result result;
  CHECK_OK(landfall_results_get(results, 0, &result));
  CHECK(result.hypothesis_count >= 1);
  const landfall_pose found = result.hypotheses[0].T_map_robot;
  CHECK(hypot(found.x_m - TRUTH.x_m, found.y_m - TRUTH.y_m) < 0.1);
  CHECK(fabs(found.theta_rad - TRUTH.theta_rad) < 0.1);

  landfall_results_free(results);
  landfall_prior_free(anywhere);
  landfall_scans_free(condensed);
  landfall_scans_free(turn);
  landfall_sensor_free(scanner);
  landfall_sensor_free(sonars);
  landfall_map_free(map);
  return 0;
}
