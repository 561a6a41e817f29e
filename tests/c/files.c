/* Maps, logs, sensors and priors written and read; windows of a drive aligned and merged. */
#include <math.h>
#include <string.h>

#include "drawn_room.h"

static void map_round_trip(void) {
  landfall_map* map = make_room();
  CHECK_OK(landfall_map_save(map, "c_room.yaml"));
  landfall_map* loaded = NULL;
  CHECK_OK(landfall_map_load("c_room.yaml", &loaded));
  landfall_grid before;
  landfall_grid after;
  CHECK_OK(landfall_map_grid(map, &before));
  CHECK_OK(landfall_map_grid(loaded, &after));
  CHECK(after.width_cells == ROOM_WIDTH && after.height_cells == ROOM_HEIGHT && after.resolution_m == 0.05);
  CHECK(memcmp(before.cells, after.cells, (size_t)(ROOM_WIDTH * ROOM_HEIGHT)) == 0);
  landfall_map_free(loaded);
  landfall_map_free(map);
}

/* Three scans a metre apart, with odometry that says so in a frame of its own. */
static landfall_scans* make_drive(const landfall_map* map, const landfall_sensor* scanner) {
  landfall_scans* drive = NULL;
  CHECK_OK(landfall_scans_new(&drive));
  for (int i = 0; i < 3; ++i) {
    const landfall_pose T_map_robot = {1.0 + i, 2.4, 0.0};
    const landfall_pose T_odom_robot = {i, 0.0, 0.0};
    float ranges_m[360];
    CHECK_OK(landfall_simulate_ranges(map, scanner, &T_map_robot, 1, ranges_m, 360));
    CHECK_OK(landfall_scans_add(drive, scanner, ranges_m, 360, i, &T_odom_robot));
  }
  return drive;
}

static void merge_and_search(const landfall_map* map, landfall_scans* drive) {
  landfall_pose T_last_robot[3];
  CHECK_OK(landfall_scans_align(drive, 0, 3, 2, T_last_robot));
  CHECK(fabs(T_last_robot[0].x_m + 2.0) < 0.05 && fabs(T_last_robot[2].x_m) < 1e-9);
  CHECK_OK(landfall_scans_merge(drive, 0, 3, T_last_robot, 2, drive));
  CHECK_OK(landfall_scans_merge(drive, 0, 3, NULL, 2, drive));
  landfall_scan merged;
  CHECK_OK(landfall_scans_get(drive, 4, &merged));
  CHECK(merged.range_count == 3 * 360 && merged.stamp_s == 2.0);

  landfall_prior* anywhere = NULL;
  landfall_results* results = NULL;
  CHECK_OK(landfall_prior_anywhere(&anywhere));
  CHECK_OK(landfall_search(map, anywhere, drive, NULL, &results));
  landfall_result result;
  CHECK_OK(landfall_results_get(results, 4, &result));
  CHECK(result.hypothesis_count > 0);
  CHECK(hypot(result.hypotheses[0].T_map_robot.x_m - 3.0, result.hypotheses[0].T_map_robot.y_m - 2.4) < 0.05);
  landfall_results_free(results);
  landfall_prior_free(anywhere);
}

static void log_round_trip(const landfall_scans* drive) {
  CHECK_OK(landfall_scans_save(drive, "c_drive.jsonl"));
  landfall_scans* loaded = NULL;
  CHECK_OK(landfall_scans_load("c_drive.jsonl", &loaded));
  CHECK(landfall_scans_count(loaded) == 3);
  landfall_scan before;
  landfall_scan after;
  CHECK_OK(landfall_scans_get(drive, 1, &before));
  CHECK_OK(landfall_scans_get(loaded, 1, &after));
  CHECK(after.stamp_s == 1.0 && after.has_odometry == 1 && after.T_odom_robot.x_m == 1.0 &&
        after.has_pose == 0);
  CHECK(after.range_count == 360 && fabsf(after.ranges_m[90] - before.ranges_m[90]) < 1e-3F);
  landfall_scans_free(loaded);

  landfall_sensor* sensor = NULL;
  CHECK_OK(landfall_sensor_load("c_drive.jsonl", NULL, &sensor));
  CHECK(landfall_sensor_beam_count(sensor) == 360);
  landfall_sensor_free(sensor);
}

static void prior_from_file(void) {
  FILE* file = fopen("c_prior.json", "w");
  CHECK(file != NULL);
  CHECK(fputs("{\"anywhere\": {}}", file) >= 0);
  CHECK(fclose(file) == 0);
  landfall_prior* prior = NULL;
  CHECK_OK(landfall_prior_load("c_prior.json", &prior));
  landfall_prior_free(prior);
}

static void prior_of_a_named_place(void) {
  FILE* file = fopen("c_room.places.yaml", "w");
  CHECK(file != NULL);
  CHECK(fputs("door: {T_map_robot: [1, 2, 0], half_x_m: 0.5, half_y_m: 0.5, half_theta_rad: 1}\n", file) >=
        0);
  CHECK(fclose(file) == 0);
  landfall_prior* prior = NULL;
  CHECK_OK(landfall_prior_place("c_room.places.yaml", "door", &prior));
  landfall_prior_free(prior);
  prior = NULL;
  CHECK(landfall_prior_place("c_room.places.yaml", "kitchen", &prior) == LANDFALL_UNKNOWN_NAME);
  CHECK(prior == NULL);
  CHECK(strstr(landfall_last_error(), "door") != NULL);
}

int main(void) {
  map_round_trip();
  landfall_map* map = make_room();
  landfall_sensor* scanner = make_scanner();
  landfall_scans* drive = make_drive(map, scanner);
  log_round_trip(drive);
  merge_and_search(map, drive);
  prior_from_file();
  prior_of_a_named_place();
  landfall_scans_free(drive);
  landfall_sensor_free(scanner);
  landfall_map_free(map);
  return 0;
}
