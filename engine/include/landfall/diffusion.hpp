// Stochastic diffusion networks at work: what the methods `sdn` and `fsdn` do, observed.
//
// Beattie & Bishop, "Self-localisation in the 'SENARIO' autonomous wheelchair". For experiments and pictures;
// search() with those methods is the way to ask where the robot was.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "landfall/prepared_map.hpp"
#include "landfall/prior.hpp"
#include "landfall/scan.hpp"

namespace landfall {

struct DiffusionOptions {
  bool focused = true;        // fsdn; false: sdn, the finest level alone
  int cells = 0;              // 0: chosen from the size of what is searched
  double top_half_m = 0.0;    // half width of the top level's regions; 0: chosen
  double top_half_rad = 0.0;  // of their headings
  int max_modes = 32;         // networks are run until so many modes are found, or none explains as well
  int threads = 0;            // 0: all
  std::uint64_t seed = 0;
  double time_budget_s = 0.0;  // 0: none
  // Of the first network: the cells after these iterations (0: initialised and tested once), and at its end.
  std::vector<int> snapshot_iterations{};
};

// All cells at one time.
struct DiffusionSnapshot {
  int iteration = 0;
  std::vector<Pose2> T_map_robot{};
  std::vector<std::uint8_t> level{};   // 0: the top
  std::vector<std::uint8_t> active{};  // 0 or 1
};

// Where a network settled.
struct DiffusionMode {
  Pose2 T_map_robot{};  // the mean of its cells, not refined
  int agreeing = 0;     // beams within their tolerance at the finest level
  int cells = 0;
  int iterations = 0;  // of the network that found it
  // Until it was found, networks before included: wall time, and processor time over all threads, rays.
  double found_ms = 0.0;
  double found_processor_ms = 0.0;
  std::int64_t found_rays_cast = 0;
};

struct DiffusionLevel {
  double half_m = 0.0;
  double half_rad = 0.0;
};

struct DiffusionRun {
  std::vector<DiffusionMode> modes{};  // in the order found; empty: lost
  std::vector<DiffusionSnapshot> snapshots{};
  std::vector<DiffusionLevel> levels{};  // top first
  double regions = 0.0;                  // of the top level that the prior holds
  int cells = 0;
  std::int64_t iterations = 0;  // of all networks, as the counts below
  std::int64_t draws = 0;       // of new mappings
  std::int64_t rays_cast = 0;
  double cast_ms = 0.0;        // processor time in ray casting, over all threads
  double processor_ms = 0.0;   // of the networks' iterations, over all threads, casting included
  double first_mode_ms = 0.0;  // wall time until the first network ended
  double total_ms = 0.0;       // wall time
};

// Throws Error{invalid_argument}: a map, prior or scan that search() would refuse, options out of range.
DiffusionRun run_diffusion(const PreparedMap& map, const PosePrior& prior, const Scan& scan,
                           const DiffusionOptions& options = {});

}  // namespace landfall
