// What occupancy-grid matching costs.
#include <nanobind/stl/tuple.h>

#include <tuple>

#include "arguments.hpp"
#include "bindings.hpp"
#include "landfall/grid_matching.hpp"

namespace landfall::python {
namespace nb = nanobind;
using namespace nb::literals;

void bind_grid_matching(nb::module_& module) {
  module.def(
      "time_grid_matching",
      [](const PreparedMap& map, const PriorArgument& prior, const Scan& scan, const SearchOptions& options,
         int repetitions) {
        const GridMatchingTimes times = time_grid_matching(map, prior, scan, options, repetitions);
        return std::tuple(times.local_grids_ms, times.matching_ms);
      },
      "map"_a, "prior"_a, "scan"_a, "options"_a, "repetitions"_a = 1,
      nb::call_guard<nb::gil_scoped_release>(),
      "(local grids, matching): milliseconds of one thread's processor time, medians, that method grid "
      "takes\n"
      "to draw the oriented local grids, and to lay them over the map at all poses of the prior. Raises\n"
      "InvalidArgument.");
}

}  // namespace landfall::python
