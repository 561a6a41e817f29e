/* landfall in C: given a map and what a robot's range sensors saw, where was the robot?
 *
 * Units and frames: metres, radians, seconds; x forward, y left, counter-clockwise positive. T_a_b takes
 * points of frame b into frame a. A grid's cell (0, 0) is its lower-left.
 *
 * Errors: a function that can fail returns landfall_status. LANDFALL_OK is 0. On any other value its outputs
 * are untouched and landfall_last_error() says what was wrong. No exception crosses this interface and
 * nothing is printed.
 *
 * Ownership: a function that gives a handle through a `**` argument gives it to the caller, who ends it with
 * the matching landfall_*_free, which accepts NULL. A handle keeps alive what it was made from: a sensor may
 * be freed while scans that use it live on. Arrays given in are read during the call only.
 *
 * Threads: any number of threads may use the same handle at once, except landfall_scans in a call that
 * changes it (the functions that take a landfall_scans* which is not const).
 *
 * Options: a struct of options starts with struct_size, is filled by its landfall_*_options_init, and is then
 * changed field by field. NULL in its place means the defaults. */
#ifndef LANDFALL_H
#define LANDFALL_H

#include <stddef.h>
#include <stdint.h>

#if defined(__GNUC__)
#define LANDFALL_API __attribute__((visibility("default")))
#else
#define LANDFALL_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Errors ---- */

typedef enum landfall_status {
  LANDFALL_OK = 0,
  LANDFALL_INVALID_ARGUMENT = 1, /* a value is outside what the function accepts, or a pointer is NULL */
  LANDFALL_UNKNOWN_NAME = 2,     /* a method, sensor or instruction set that does not exist */
  LANDFALL_FILE_NOT_FOUND = 3,
  LANDFALL_FILE_FORMAT = 4, /* the message names file, line, field, value found and what was expected */
  LANDFALL_FILE_WRITE = 5,
  LANDFALL_TOO_LARGE = 6,     /* a size beyond what is taken, refused before memory is */
  LANDFALL_OUT_OF_MEMORY = 7, /* the system refused memory */
  LANDFALL_INTERNAL = 8       /* a fault of landfall itself */
} landfall_status;

/* The message of this thread's last call that failed; "" where none has. Valid until the next call that fails
 * in this thread. Never NULL. */
LANDFALL_API const char* landfall_last_error(void);

/* The library's version, such as "0.1.0". */
LANDFALL_API const char* landfall_version(void);

/* ---- Values ---- */

typedef struct landfall_pose {
  double x_m;
  double y_m;
  double theta_rad;
} landfall_pose;

typedef struct landfall_point {
  double x_m;
  double y_m;
} landfall_point;

typedef struct landfall_wall {
  landfall_point a_map;
  landfall_point b_map;
} landfall_wall;

/* Values of a grid's cells. */
enum { LANDFALL_FREE = 0, LANDFALL_OCCUPIED = 1, LANDFALL_UNKNOWN = 2 };

/* ---- Maps ---- */

/* A map with all that a search derives from it; immutable. */
typedef struct landfall_map landfall_map;

/* Reads a ROS map_server yaml with its image, or a wall plan (.json). */
LANDFALL_API landfall_status landfall_map_load(const char* path, landfall_map** map);

typedef struct landfall_grid {
  int32_t width_cells;
  int32_t height_cells;
  double resolution_m;
  landfall_pose T_map_grid; /* the lower-left corner of cell (0, 0), and the direction of the grid's axes */
  const uint8_t*
      cells; /* width x height values LANDFALL_FREE, _OCCUPIED or _UNKNOWN, row by row from below */
} landfall_grid;

/* A map from an array of cells, which is copied. */
LANDFALL_API landfall_status landfall_map_from_grid(const landfall_grid* grid, landfall_map** map);

/* A map from straight walls, in metres; searched on a grid of resolution_m, verified against the exact walls.
 */
LANDFALL_API landfall_status landfall_map_from_walls(const landfall_wall* walls, size_t wall_count,
                                                     double resolution_m, landfall_map** map);

/* The map's grid. grid->cells points into the map and is valid until the map is freed. */
LANDFALL_API landfall_status landfall_map_grid(const landfall_map* map, landfall_grid* grid);

/* Derives now what a search would derive on first need. */
LANDFALL_API landfall_status landfall_map_prepare(const landfall_map* map);

/* Writes yaml, and a pgm beside it. */
LANDFALL_API landfall_status landfall_map_save(const landfall_map* map, const char* yaml_path);

LANDFALL_API void landfall_map_free(landfall_map* map);

/* ---- Sensors ---- */

/* A list of beams: a laser scanner, several scanners, a ring of sonars; immutable. */
typedef struct landfall_sensor landfall_sensor;

typedef struct landfall_beam {
  landfall_pose T_robot_beam; /* origin of the ray in the robot's frame, and its direction as the heading */
  double half_angle_rad;      /* 0: a ray; a cone of 12 degrees has 6 degrees here */
  double range_min_m;         /* a shorter reading is invalid */
  double range_max_m;         /* this or more means that nothing was hit */
} landfall_beam;

/* Noise: one sigma is range_noise_m + range_noise_relative * range. */
LANDFALL_API landfall_status landfall_sensor_from_beams(const landfall_beam* beams, size_t beam_count,
                                                        double range_noise_m, double range_noise_relative,
                                                        landfall_sensor** sensor);

/* An evenly spaced fan: beam i points to first_rad + i * step_rad in the sensor's frame. */
typedef struct landfall_fan_options {
  size_t struct_size;
  int32_t beam_count;           /* 180 */
  double first_rad;             /* -pi / 2 */
  double step_rad;              /* pi / 180 */
  landfall_pose T_robot_sensor; /* the robot's centre */
  double half_angle_rad;        /* 0 */
  double range_min_m;           /* 0 */
  double range_max_m;           /* 80 */
  double range_noise_m;         /* 0.01 */
  double range_noise_relative;  /* 0 */
} landfall_fan_options;

LANDFALL_API void landfall_fan_options_init(landfall_fan_options* options);
LANDFALL_API landfall_status landfall_sensor_fan(const landfall_fan_options* options,
                                                 landfall_sensor** sensor);

/* The sensor called `name` in a sensor yaml or a .jsonl log. NULL: the only one there. */
LANDFALL_API landfall_status landfall_sensor_load(const char* path, const char* name,
                                                  landfall_sensor** sensor);

/* 0 where sensor is NULL. */
LANDFALL_API size_t landfall_sensor_beam_count(const landfall_sensor* sensor);

LANDFALL_API void landfall_sensor_free(landfall_sensor* sensor);

/* ---- Scans ---- */

/* A list of scans: a log, or what the caller puts together. */
typedef struct landfall_scans landfall_scans;

/* An empty list. */
LANDFALL_API landfall_status landfall_scans_new(landfall_scans** scans);

/* CARMEN text, scan lines (.jsonl), sonar tables; gzipped or not. */
LANDFALL_API landfall_status landfall_scans_load(const char* path, landfall_scans** scans);

/* Writes scan lines (.jsonl). */
LANDFALL_API landfall_status landfall_scans_save(const landfall_scans* scans, const char* jsonl_path);

/* Appends one scan: a range in metres for each of the sensor's beams (NaN: invalid; range_max_m or more:
 * nothing hit). T_odom_robot is odometry at that time, NULL where there is none. */
LANDFALL_API landfall_status landfall_scans_add(landfall_scans* scans, const landfall_sensor* sensor,
                                                const float* ranges_m, size_t range_count, double stamp_s,
                                                const landfall_pose* T_odom_robot);

/* 0 where scans is NULL. */
LANDFALL_API size_t landfall_scans_count(const landfall_scans* scans);

typedef struct landfall_scan {
  double stamp_s;
  const float* ranges_m; /* one per beam; valid until the list is changed or freed */
  size_t range_count;
  int32_t has_odometry; /* 1: T_odom_robot is set */
  landfall_pose T_odom_robot;
  int32_t has_pose; /* 1: the log gave a pose, never used by search */
  landfall_pose T_map_robot;
} landfall_scan;

LANDFALL_API landfall_status landfall_scans_get(const landfall_scans* scans, size_t index,
                                                landfall_scan* scan);

/* Where scans first .. first + count - 1 were taken, in the robot's frame of scan `reference` (an index into
 * the list): odometry polished by matching the scans to each other. Writes `count` poses. */
LANDFALL_API landfall_status landfall_scans_align(const landfall_scans* scans, size_t first, size_t count,
                                                  size_t reference, landfall_pose* T_reference_robot);

/* Appends to `merged` one scan with the beams of scans first .. first + count - 1, in the robot's frame and
 * under the stamp of scan `reference` (an index into the list). T_common_robot: where each was taken, in one
 * common frame; NULL: by odometry. `merged` may be `scans` itself. */
LANDFALL_API landfall_status landfall_scans_merge(const landfall_scans* scans, size_t first, size_t count,
                                                  const landfall_pose* T_common_robot, size_t reference,
                                                  landfall_scans* merged);

/* Appends to `condensed` what can be trusted of a slow turn on the spot, as one scan: scans first .. first +
 * count - 1, of one sensor, were taken at headings i 2 pi / count of scan `first`'s robot frame. Sonars read
 * too long where sound meets a wall at a slant; kept are the local minima along the turn, over all beams
 * together. landfall_search proposes poses by these and judges them by all the readings, which the scan
 * keeps (logs do not). `condensed` may be `scans` itself. */
LANDFALL_API landfall_status landfall_scans_merge_turn_minima(const landfall_scans* scans, size_t first,
                                                              size_t count, landfall_scans* condensed);

LANDFALL_API void landfall_scans_free(landfall_scans* scans);

/* ---- Simulation ---- */

/* Noise-free ranges from each pose: ranges_m[i * beam_count + b], +inf where beam b hits nothing within its
 * range_max_m. range_count must be pose_count x beam_count. */
LANDFALL_API landfall_status landfall_simulate_ranges(const landfall_map* map, const landfall_sensor* sensor,
                                                      const landfall_pose* T_map_robot, size_t pose_count,
                                                      float* ranges_m, size_t range_count);

/* Appends a scan per pose, with the sensor's noise drawn from `seed`. Stamps are 0, poses are set. */
LANDFALL_API landfall_status landfall_simulate(const landfall_map* map, const landfall_sensor* sensor,
                                               const landfall_pose* T_map_robot, size_t pose_count,
                                               uint64_t seed, landfall_scans* scans);

/* ---- Priors: where to look, in the map's frame ---- */

typedef struct landfall_prior landfall_prior;

/* Everywhere that is free, any heading. */
LANDFALL_API landfall_status landfall_prior_anywhere(landfall_prior** prior);

/* A box along the map's axes and a cone of headings around a pose; half widths. */
LANDFALL_API landfall_status landfall_prior_window(landfall_pose T_map_robot, double half_x_m,
                                                   double half_y_m, double half_theta_rad,
                                                   landfall_prior** prior);

/* covariance: 9 numbers of (x_m, y_m, theta_rad), row by row. Looks within three sigma. */
LANDFALL_API landfall_status landfall_prior_gaussian(landfall_pose T_map_robot, const double covariance[9],
                                                     landfall_prior** prior);

/* A simple polygon, with headings within half_theta_rad of theta_rad (pi: any). */
LANDFALL_API landfall_status landfall_prior_region(const landfall_point* polygon_map, size_t point_count,
                                                   double theta_rad, double half_theta_rad,
                                                   landfall_prior** prior);

/* Within radii_m[i] of one of the points, any heading. */
LANDFALL_API landfall_status landfall_prior_beacons(const landfall_point* p_map, const double* radii_m,
                                                    size_t count, landfall_prior** prior);

/* At one of these poses. */
LANDFALL_API landfall_status landfall_prior_poses(const landfall_pose* T_map_robot, size_t count,
                                                  landfall_prior** prior);

/* One of several priors, with these weights; the components are copied. */
LANDFALL_API landfall_status landfall_prior_mixture(const landfall_prior* const* components,
                                                    const double* weights, size_t count,
                                                    landfall_prior** prior);

/* A prior as JSON. */
LANDFALL_API landfall_status landfall_prior_load(const char* path, landfall_prior** prior);

/* A place by its name, of a file of named places (yaml: a polygon, or a pose and its spread, for each name).
 * A name that the file does not have is LANDFALL_UNKNOWN_NAME; the message lists those that it has. */
LANDFALL_API landfall_status landfall_prior_place(const char* places_path, const char* name,
                                                  landfall_prior** prior);

LANDFALL_API void landfall_prior_free(landfall_prior* prior);

/* ---- Search ---- */

/* Ends searches that are under way, from another thread. */
typedef struct landfall_stop landfall_stop;

LANDFALL_API landfall_status landfall_stop_new(landfall_stop** stop);

/* Ends every search whose options name it, now and from now on: what is answered stays, the other scans are
 * lost with a reason. May be called from any thread; not from a signal handler. */
LANDFALL_API landfall_status landfall_stop_request(landfall_stop* stop);

LANDFALL_API void landfall_stop_free(landfall_stop* stop);

typedef struct landfall_search_options {
  size_t struct_size;
  const char* method;            /* "auto"; a name of landfall_method_get */
  double translation_step_m;     /* 0: the map's resolution; else a multiple of it */
  double rotation_step_rad;      /* pi / 360 */
  int32_t max_hypotheses;        /* 5; 1 to 1000 */
  int32_t threads;               /* 0: all */
  double time_budget_s;          /* 0: none; else for each scan: the best so far, not proven */
  uint64_t seed;                 /* 0; of methods that draw random numbers */
  double robot_radius_m;         /* 0; a pose is possible where this disc is free */
  double distinct_translation_m; /* 0.5; hypotheses nearer than this and the next are one */
  double distinct_rotation_rad;  /* pi / 18 */
  const landfall_stop* stop;     /* NULL: none; read during the call only */
} landfall_search_options;

LANDFALL_API void landfall_search_options_init(landfall_search_options* options);

typedef enum landfall_verdict {
  LANDFALL_FOUND = 0,     /* probability >= 0.95 and explained >= 0.5 */
  LANDFALL_AMBIGUOUS = 1, /* several poses fit */
  LANDFALL_LOST = 2       /* the map explains less than half of the beams, or there is nothing to go by */
} landfall_verdict;

typedef struct landfall_hypothesis {
  landfall_pose T_map_robot;           /* refined below the grid's step */
  landfall_pose T_map_robot_unrefined; /* the method's own answer */
  int64_t score;                       /* the method's own */
  double explained;                    /* share of valid beams that the map explains from there */
  double probability;                  /* the mode's posterior mass over the prior, all maps together */
  double covariance[9];                /* of (x_m, y_m, theta_rad) in the map's frame, row by row */
  int32_t map_index;                   /* which of the maps given */
} landfall_hypothesis;

/* The answer to one scan. Pointers are valid until the results are freed. */
typedef struct landfall_result {
  landfall_verdict verdict;
  int32_t proven;                        /* 1: no pose of the prior's lattice scores higher */
  const landfall_hypothesis* hypotheses; /* ranked, distinct; none where there is nothing to go by */
  size_t hypothesis_count;
  const char* reason; /* why lost; "" otherwise */
  const char* method; /* which answered, with its instruction set */
  double stamp_s;
  int32_t beams_valid;
  int32_t beams_echo;
  int64_t poses_covered;
  int64_t poses_scored;
  int64_t bounds_computed;
  int64_t rays_cast;
  double prepare_ms; /* wall times, milliseconds */
  double propose_ms;
  double refine_ms;
  double verify_ms;
  double rank_ms;
  double total_ms;
} landfall_result;

typedef struct landfall_results landfall_results;

/* Answers each scan of the list, in parallel; scans that follow each other with odometry are answered faster,
 * with the same answers. A scan without a valid beam is an answer (lost), not an error.
 */
LANDFALL_API landfall_status landfall_search(const landfall_map* map, const landfall_prior* prior,
                                             const landfall_scans* scans,
                                             const landfall_search_options* options,
                                             landfall_results** results);

/* The same over several maps: hypotheses are ranked across them. prior_count is 1 (for all scans) or one per
 * scan. */
LANDFALL_API landfall_status landfall_search_maps(const landfall_map* const* maps, size_t map_count,
                                                  const landfall_prior* const* priors, size_t prior_count,
                                                  const landfall_scans* scans,
                                                  const landfall_search_options* options,
                                                  landfall_results** results);

/* As many as there were scans; 0 where results is NULL. */
LANDFALL_API size_t landfall_results_count(const landfall_results* results);

LANDFALL_API landfall_status landfall_results_get(const landfall_results* results, size_t index,
                                                  landfall_result* result);

LANDFALL_API void landfall_results_free(landfall_results* results);

/* ---- What this build can do ---- */

typedef struct landfall_method {
  const char* name;
  const char* summary;
  const char* source; /* the publication; "" where there is none */
} landfall_method;

LANDFALL_API size_t landfall_method_count(void);

/* Strings are valid for as long as the program runs. */
LANDFALL_API landfall_status landfall_method_get(size_t index, landfall_method* method);

/* The instruction set that the kernels run with, such as "AVX2"; lowered by the environment variable
 * LANDFALL_ISA. Valid until the next call in this thread. */
LANDFALL_API landfall_status landfall_active_isa(const char** isa);

/* What schedules parallel work: "tbb", or "openmp" where the environment variable LANDFALL_EXECUTOR says so,
 * for hosts that run on OpenMP. LANDFALL_UNKNOWN_NAME where it names what this build lacks. Valid until the
 * next call in this thread. */
LANDFALL_API landfall_status landfall_active_executor(const char** executor);

/* How this sensor's rays are cast over this map, in simulation and in search: "distance_walk" (from one free
 * square of a grid to the next) or "embree" (against walls) for beams, "segment_tree" for those with a
 * half-angle; both names, with a comma, where it has both. Builds what beams are cast against where the map
 * has not built it yet. Valid until the next call in this thread. */
LANDFALL_API landfall_status landfall_ray_caster(const landfall_map* map, const landfall_sensor* sensor,
                                                 const char** ray_caster);

#ifdef __cplusplus
}
#endif

#endif
