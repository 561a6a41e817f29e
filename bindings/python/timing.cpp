// Parts timed alone, for the papers' experiments: not what the package offers.
#include <nanobind/stl/tuple.h>

#include <tuple>
#include <vector>

#include "arguments.hpp"
#include "arrays.hpp"
#include "bindings.hpp"
#include "engine/methods/grid/time_matching.hpp"
#include "engine/methods/sdn/bare_rays.hpp"

namespace landfall::python {
namespace nb = nanobind;
using namespace nb::literals;

void bind_timing(nb::module_& module) {
  module.def(
      "time_grid_matching",
      [](const PreparedMap& map, const PriorArgument& prior, const Scan& scan, const SearchOptions& options,
         int repetitions) {
        const auto times = internal::time_grid_matching(map, prior, scan, options, repetitions);
        return std::tuple(times.local_grids_ms, times.matching_ms);
      },
      "map"_a, "prior"_a, "scan"_a, "options"_a, "repetitions"_a = 1,
      nb::call_guard<nb::gil_scoped_release>(),
      "(local grids, matching): milliseconds of one thread's processor time, medians, that method grid "
      "takes\n"
      "to draw the oriented local grids, and to lay them over the map at all poses of the prior. Raises\n"
      "InvalidArgument.");
  module.def(
      "time_bare_rays",
      [](const PreparedMap& map, const Sensor& sensor, const PosesArgument& T_map_robot) {
        const std::vector<Pose2> poses = poses_from(T_map_robot, "time_bare_rays");
        const nb::gil_scoped_release released;
        return internal::time_bare_rays(map, sensor, poses);
      },
      "map"_a, "sensor"_a, "T_map_robot"_a,
      "Processor time in seconds for casting one ray from each pose, beams in turn: the raycaster alone.");
}

}  // namespace landfall::python
