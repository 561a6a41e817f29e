// Scans by ray casting: what a sensor would see from given poses.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "landfall/prepared_map.hpp"
#include "landfall/scan.hpp"

namespace landfall {

// ranges_m[i * beams + b]: noise-free range of beam b from T_map_robot[i]; +inf: nothing within the
// beam's range_max_m. A beam with a half-angle returns the nearest wall point in its cone, exactly.
std::vector<float> simulate_ranges(const PreparedMap& map, const Sensor& sensor,
                                   std::span<const Pose2> T_map_robot);

// How rays of this sensor are cast over this map, in simulation and in search's verification: "distance_walk"
// (from one free square of a grid to the next) or "embree" (against walls) for beams, "segment_tree" for
// those with a half-angle; both names, with a comma, where a sensor has both. The fastest for the map as far
// as was measured (bench/RESULTS.md, Rays: SSE4 to AVX-512, grids of 0.3 to 20 million cells); ranges do not
// depend on it but for rounding. Builds what beams are cast against where the map has not built it yet, as
// the first simulation does. Throws Error{invalid_argument}: a sensor that does not validate.
std::string ray_caster(const PreparedMap& map, const Sensor& sensor);

struct SimulateOptions {
  bool noise = true;  // the sensor's range_noise_m and range_noise_relative, Gaussian
  std::uint64_t seed = 0;
};
// One scan per pose, T_map_robot set; nothing hit is the beam's range_max_m. The noise of (seed, pose
// index, beam) does not depend on threads.
std::vector<Scan> simulate(const PreparedMap& map, std::shared_ptr<const Sensor> sensor,
                           std::span<const Pose2> T_map_robot, const SimulateOptions& options = {});

}  // namespace landfall
