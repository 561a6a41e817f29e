// Mapping without odometry: each scan is matched to the map built so far, and the map grows with each scan
// (Okada & Fujimoto, Grid-based Localization and Mapping Method without Odometry Information).
#pragma once

#include <cstdint>
#include <memory>
#include <numbers>
#include <span>
#include <vector>

#include "landfall/grid_map.hpp"
#include "landfall/scan.hpp"

namespace landfall {

// The particle swarm of section II.B.2; the defaults are the published values.
struct SwarmOptions {
  int particles = 40;         // a quarter along x, a quarter along y, the rest turned
  int iterations = 30;        // K_max
  double inertia = 0.7;       // omega
  double own_pull = 0.8;      // c1
  double swarm_pull = 0.8;    // c2
  double good_enough = 0.05;  // epsilon: the flight ends where f falls below
  double reach_m = 0.5;       // of the start pattern, to either side
  double reach_rad = 50.0 * std::numbers::pi / 180.0;
};

enum class SlamMatcher : std::uint8_t {
  pso,               // the swarm
  branch_and_bound,  // the best pose of a window as wide as the swarm's start pattern, proven
};
enum class SlamPrediction : std::uint8_t {
  still,              // where the last scan was, as published
  constant_velocity,  // moved on as from the scan before to the last one
  odometry,           // moved on as odometry says; as `still` where a scan has none
};

struct SlamOptions {
  SlamMatcher matcher = SlamMatcher::pso;
  SlamPrediction prediction = SlamPrediction::still;
  SwarmOptions swarm{};
  bool refine = true;  // matches are polished below the cell, point to line; false: as published
  double resolution_m = 0.02;
  double range_min_m = 0.3;       // nearer echoes are not matched (Data_valid), nor drawn
  double range_max_m = 0.0;       // farther echoes are left out; 0: no limit
  double deletion_range_m = 2.0;  // obstacles so near that the scanner sees through are deleted; 0: none
  // Of the points that meet something known, so many must lie on walls, not in free space; else the match is
  // rejected and a wider search follows.
  double least_agreement = 0.6;
  double recovery_reach_m = 1.5;  // of the wider search, any heading; wider after each scan without match
  double log_odds_hit = 0.85;     // as in MappingOptions
  double log_odds_miss = -0.4;
  double occupied_log_odds = 0.4;
  double free_log_odds = -0.2;
  double max_log_odds = 3.5;
  double min_log_odds =
      -1.2;  // free space is not surer than that: what appears in it is drawn at its second echo
  std::uint64_t seed = 0;
  int threads = 1;  // of `branch_and_bound` and of recoveries; answers do not depend on it
};

// What became of one scan.
struct SlamStep {
  Pose2 T_map_robot;         // where it was taken; of a scan without match, as predicted
  bool accepted = false;     // it is part of the map
  bool recovered = false;    // by the wider search
  double fit = 0.0;          // share of the valid echoes in the map's cells, there: 1 - f
  double agreement = 0.0;    // see least_agreement
  int cells_deleted = 0;     // obstacles that were seen through
  double match_ms = 0.0;     // wall time, without recovery
  double recovery_ms = 0.0;  // of the wider search
  double insert_ms = 0.0;    // of growing the map
};

namespace internal {
class SlamState;
}

// A map under construction. The first scan founds it: its robot stands at (0, 0, 0).
class Slam {
 public:
  // Throws Error{invalid_argument} that names the option.
  explicit Slam(const SlamOptions& options = {});
  ~Slam();
  Slam(Slam&&) noexcept;
  Slam& operator=(Slam&&) noexcept;

  // Matches the scan and, where it fits, adds it. A scan without valid echoes is not accepted; until one is,
  // there is no map. Throws Error{invalid_argument}: a scan that does not validate; Error{too_large}: a map
  // beyond limits.
  SlamStep add(const Scan& scan);
  // The cells known so far; a single unknown one where there are none.
  [[nodiscard]] GridMap map() const;
  [[nodiscard]] std::size_t memory_bytes() const;

 private:
  std::unique_ptr<internal::SlamState> state_;
};

struct SlamResult {
  std::vector<SlamStep> steps;  // one per scan
  GridMap map;
};
// All scans, one after the other. Throws as Slam does, and for no scans.
SlamResult slam(std::span<const Scan> scans, const SlamOptions& options = {});

}  // namespace landfall
