// Stochastic diffusion networks, observed.
#include <nanobind/stl/vector.h>

#include <vector>

#include "arguments.hpp"
#include "arrays.hpp"
#include "bindings.hpp"
#include "landfall/diffusion.hpp"

namespace landfall::python {
namespace nb = nanobind;
using namespace nb::literals;

namespace {

void bind_snapshots(nb::module_& module) {
  nb::class_<DiffusionSnapshot>(module, "DiffusionSnapshot", "All cells of a network at one iteration.")
      .def_ro("iteration", &DiffusionSnapshot::iteration)
      .def_prop_ro(
          "poses",
          [](const DiffusionSnapshot& snapshot) {
            std::vector<double> rows;
            for (const Pose2& pose : snapshot.T_map_robot)
              rows.insert(rows.end(), {pose.x_m, pose.y_m, pose.theta_rad});
            return adopt(std::move(rows), snapshot.T_map_robot.size(), std::size_t{3});
          },
          nb::rv_policy::move, "(cells, 3) float64: x_m, y_m, theta_rad in the map frame.")
      .def_ro("level", &DiffusionSnapshot::level, "Per cell; 0 is the top.")
      .def_ro("active", &DiffusionSnapshot::active, "Per cell, 0 or 1.");
  nb::class_<DiffusionMode>(module, "DiffusionMode", "Where a network settled.")
      .def_ro("T_map_robot", &DiffusionMode::T_map_robot, "The mean of its cells, not refined.")
      .def_ro("agreeing", &DiffusionMode::agreeing, "Beams within their tolerance at the finest level.")
      .def_ro("cells", &DiffusionMode::cells)
      .def_ro("iterations", &DiffusionMode::iterations, "Of the network that found it.")
      .def_ro("found_ms", &DiffusionMode::found_ms, "Wall time until it was found.")
      .def_ro("found_processor_ms", &DiffusionMode::found_processor_ms, "Processor time, over all threads.")
      .def_ro("found_rays_cast", &DiffusionMode::found_rays_cast, "Rays cast until it was found.");
  nb::class_<DiffusionLevel>(module, "DiffusionLevel", "A focus level: half widths of its regions.")
      .def_ro("half_m", &DiffusionLevel::half_m)
      .def_ro("half_rad", &DiffusionLevel::half_rad);
}

void bind_run(nb::module_& module) {
  nb::class_<DiffusionRun>(module, "DiffusionRun", "What run_diffusion() saw.")
      .def_ro("modes", &DiffusionRun::modes, "In the order found; empty: lost.")
      .def_ro("snapshots", &DiffusionRun::snapshots)
      .def_ro("levels", &DiffusionRun::levels, "Top first.")
      .def_ro("regions", &DiffusionRun::regions, "Of the top level that the prior holds.")
      .def_ro("cells", &DiffusionRun::cells)
      .def_ro("iterations", &DiffusionRun::iterations, "Of all networks.")
      .def_ro("draws", &DiffusionRun::draws, "Of new mappings.")
      .def_ro("rays_cast", &DiffusionRun::rays_cast)
      .def_ro("cast_ms", &DiffusionRun::cast_ms, "Processor time in ray casting, over all threads.")
      .def_ro("processor_ms", &DiffusionRun::processor_ms, "Processor time of the networks' steps.")
      .def_ro("first_mode_ms", &DiffusionRun::first_mode_ms, "Wall time until the first network ended.")
      .def_ro("total_ms", &DiffusionRun::total_ms, "Wall time.");
}

}  // namespace

void bind_diffusion(nb::module_& module) {
  bind_snapshots(module);
  bind_run(module);
  const DiffusionOptions defaults;
  module.def(
      "run_diffusion",
      [](const PreparedMap& map, const PriorArgument& prior, const Scan& scan, bool focused, int cells,
         double top_half_m, double top_half_rad, int max_modes, int threads, std::uint64_t seed,
         double time_budget_s, const std::vector<int>& snapshot_iterations) {
        const DiffusionOptions options{.focused = focused,
                                       .cells = cells,
                                       .top_half_m = top_half_m,
                                       .top_half_rad = top_half_rad,
                                       .max_modes = max_modes,
                                       .threads = threads,
                                       .seed = seed,
                                       .time_budget_s = time_budget_s,
                                       .snapshot_iterations = snapshot_iterations};
        const nb::gil_scoped_release released;
        return run_diffusion(map, prior, scan, options);
      },
      "map"_a, "prior"_a, "scan"_a, nb::kw_only(), "focused"_a = defaults.focused, "cells"_a = defaults.cells,
      "top_half_m"_a = defaults.top_half_m, "top_half_rad"_a = defaults.top_half_rad,
      "max_modes"_a = defaults.max_modes, "threads"_a = defaults.threads, "seed"_a = defaults.seed,
      "time_budget_s"_a = defaults.time_budget_s, "snapshot_iterations"_a = defaults.snapshot_iterations,
      "What methods `sdn` and `fsdn` do, observed: the modes before refinement, counts and times, and, of "
      "the first\nnetwork, its cells at some iterations and at its end. 0 cells or a top of 0: chosen. "
      "Raises InvalidArgument.");
}

}  // namespace landfall::python
