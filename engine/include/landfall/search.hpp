// Where was the robot? The one entry of the engine.
#pragma once

#include <array>
#include <cstdint>
#include <numbers>
#include <optional>
#include <span>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

#include "landfall/prepared_map.hpp"
#include "landfall/prior.hpp"
#include "landfall/scan.hpp"

namespace landfall {

struct SearchOptions {
  std::string method = "auto";                          // a name of methods()
  double translation_step_m = 0.0;                      // 0: the map's resolution; else a multiple of it
  double rotation_step_rad = std::numbers::pi / 360.0;  // 0.5 degrees
  int max_hypotheses = 5;                               // 1 to 1000
  double time_budget_s = 0.0;           // 0: none; else per scan: the best so far, proven = false
  int threads = 0;                      // 0: all
  std::uint64_t seed = 0;               // of methods that draw random numbers
  double robot_radius_m = 0.0;          // a pose is possible where this disc is free
  double distinct_translation_m = 0.5;  // hypotheses nearer than both are one
  double distinct_rotation_rad = std::numbers::pi / 18.0;  // 10 degrees
  // Another thread's std::stop_source ends the search as a time budget would: what is answered stays, the
  // other scans are lost with a reason.
  std::stop_token stop{};
};

struct Hypothesis {
  Pose2 T_map_robot;            // refined below the grid step
  Pose2 T_map_robot_unrefined;  // the method's own answer
  std::int64_t score = 0;       // the method's own; field methods: the sum of the field over the echoes
  double explained = 0.0;       // share of valid beams that the map explains from T_map_robot
  double probability = 0.0;     // the mode's posterior mass over the prior's domain (all maps)
  std::array<double, 9> covariance{};  // of (x_m, y_m, theta_rad) in the map frame, row by row
  int map_index = 0;                   // which of the maps given
};

enum class Verdict { found, ambiguous, lost };
std::string_view to_string(Verdict verdict);

// Wall time of each stage of a query, milliseconds.
struct StageTimes {
  double prepare_ms = 0.0;  // building what the map lacked (first query only)
  double propose_ms = 0.0;
  double refine_ms = 0.0;
  double verify_ms = 0.0;
  double rank_ms = 0.0;
  double total_ms = 0.0;
};

// How much was done for an answer. Bounds and scored poses vary with threads and with what a batch happened
// to answer before.
struct SearchCounts {
  std::int64_t poses_covered = 0;  // lattice poses of the prior, after the free-space mask
  std::int64_t poses_scored = 0;   // of these, scored one by one; the rest were excluded by bounds
  std::int64_t bounds_computed = 0;
  std::int64_t rays_cast = 0;
};

struct SearchResult {
  std::vector<Hypothesis> hypotheses;  // ranked, distinct; empty where there is nothing to go by
  Verdict verdict = Verdict::lost;
  std::string reason;   // why lost (no valid beam, prior without free cell, ...); empty otherwise
  bool proven = false;  // no lattice pose of the prior scores higher than the best one found
  std::string method;   // the method that answered ("auto" resolved), with its instruction set and, where
                        // it has several, its way: "fft (AVX2, direct)"
  int beams_valid = 0;
  int beams_echo = 0;
  double stamp_s = 0.0;
  SearchCounts counts;
  StageTimes times;
};

// results[i] answers scans[i]; each scan is its own question under the same prior. A batch is answered
// in parallel and equals the loop over its scans, but is faster where they follow each other with odometry:
// one's answer tells where to look for the next first. Safe from any thread. Throws Error{invalid_argument,
// unknown_name}: an option, prior or scan that does not validate, a prior entirely off the map. A scan
// without a valid beam is an answer (lost), not an error.
std::vector<SearchResult> search(const PreparedMap& map, const PosePrior& prior, std::span<const Scan> scans,
                                 const SearchOptions& options = {});
// One prior per scan.
std::vector<SearchResult> search(const PreparedMap& map, std::span<const PosePrior> priors,
                                 std::span<const Scan> scans, const SearchOptions& options = {});
// Several maps: hypotheses are ranked across them; one prior for all scans, or one per scan.
std::vector<SearchResult> search(std::span<const PreparedMap> maps, std::span<const PosePrior> priors,
                                 std::span<const Scan> scans, const SearchOptions& options = {});
SearchResult search(const PreparedMap& map, const PosePrior& prior, const Scan& scan,
                    const SearchOptions& options = {});

struct MethodInfo {
  std::string_view name;
  std::string_view summary;
  std::string_view source;  // publication; empty where there is none
};
std::span<const MethodInfo> methods();
// The instruction set that the kernels run with ("AVX3_ZEN4", "AVX2", ..., "SCALAR"). Forced lower by
// the environment variable LANDFALL_ISA; an unknown name there throws Error{unknown_name} here.
std::string active_isa();
// What schedules parallel work: "tbb", or "openmp" where the environment variable LANDFALL_EXECUTOR says so
// (for hosts that run on OpenMP); an unknown name there throws Error{unknown_name} here. Inside a host's
// region of the same scheduler search() uses at most the threads of the host's arena, or those that OpenMP
// offers a nested region (1 where regions may not nest); inside one of the other, the calling thread alone.
// A build without OpenMP does not see OpenMP's regions. Answers do not depend on any of this.
std::string active_executor();

}  // namespace landfall
