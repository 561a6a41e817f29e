// Scans from maps and maps from scans: simulation and mapping.
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <cstdint>
#include <memory>
#include <vector>

#include "arguments.hpp"
#include "arrays.hpp"
#include "bindings.hpp"
#include "landfall/mapping.hpp"
#include "landfall/simulate.hpp"

namespace landfall::python {
namespace nb = nanobind;
using namespace nb::literals;

namespace {

using SensorPtr = std::shared_ptr<const Sensor>;

Matrix<float> ranges_array(const PreparedMap& map, const Sensor& sensor, const PosesArgument& rows) {
  const std::vector<Pose2> T_map_robot = poses_from(rows, "simulate_ranges");
  std::vector<float> ranges;
  {
    const nb::gil_scoped_release released;
    ranges = simulate_ranges(map, sensor, T_map_robot);
  }
  return adopt(std::move(ranges), T_map_robot.size(), sensor.beams.size());
}

std::vector<Scan> simulated_scans(const PreparedMap& map, SensorPtr sensor, const PosesArgument& rows,
                                  bool noise, std::uint64_t seed) {
  const std::vector<Pose2> T_map_robot = poses_from(rows, "simulate");
  const nb::gil_scoped_release released;
  return simulate(map, std::move(sensor), T_map_robot, {.noise = noise, .seed = seed});
}

void bind_simulate(nb::module_& module) {
  module.def("simulate_ranges", &ranges_array, "map"_a, "sensor"_a, "T_map_robot"_a,
             "Noise-free ranges: (poses, beams) float32, +inf where nothing is hit within range_max_m.\n"
             "T_map_robot: a list of poses, or an array (poses, 3).");
  const SimulateOptions options;
  module.def("ray_caster", &ray_caster, "map"_a, "sensor"_a, nb::call_guard<nb::gil_scoped_release>(),
             "How this sensor's rays are cast over this map: \"distance_walk\" or \"embree\" for beams,\n"
             "\"segment_tree\" for those with a half-angle, both where it has both. Raises InvalidArgument.\n"
             "Builds what beams are cast against where the map has not built it yet, as a simulation does.");
  module.def("simulate", &simulated_scans, "map"_a, "sensor"_a, "T_map_robot"_a, nb::kw_only(),
             "noise"_a = options.noise, "seed"_a = options.seed,
             "One scan per pose, its T_map_robot set, with the sensor's noise.\n"
             "T_map_robot: a list of poses, or an array (poses, 3).");
}

void bind_mapping(nb::module_& module) {
  const MappingOptions defaults;
  module.def(
      "map_from_known_poses",
      [](const std::vector<Scan>& scans, double resolution_m, double range_max_m, double margin_m,
         double log_odds_hit, double log_odds_miss, double occupied_log_odds, double free_log_odds,
         double max_log_odds) {
        const nb::gil_scoped_release released;
        return map_from_known_poses(scans, {.resolution_m = resolution_m,
                                            .log_odds_hit = log_odds_hit,
                                            .log_odds_miss = log_odds_miss,
                                            .occupied_log_odds = occupied_log_odds,
                                            .free_log_odds = free_log_odds,
                                            .max_log_odds = max_log_odds,
                                            .range_max_m = range_max_m,
                                            .margin_m = margin_m});
      },
      "scans"_a, nb::kw_only(), "resolution_m"_a = defaults.resolution_m,
      "range_max_m"_a = defaults.range_max_m, "margin_m"_a = defaults.margin_m,
      "log_odds_hit"_a = defaults.log_odds_hit, "log_odds_miss"_a = defaults.log_odds_miss,
      "occupied_log_odds"_a = defaults.occupied_log_odds, "free_log_odds"_a = defaults.free_log_odds,
      "max_log_odds"_a = defaults.max_log_odds,
      "A GridMap from scans whose T_map_robot is set. range_max_m: longer echoes free their first\n"
      "range_max_m only (0: no limit). Raises InvalidArgument, TooLarge.");
}

}  // namespace

void bind_logs(nb::module_& module) {
  bind_simulate(module);
  bind_mapping(module);
}

}  // namespace landfall::python
