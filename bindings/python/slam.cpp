// Mapping without odometry, and scans matched without a map.
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include <array>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "arguments.hpp"
#include "bindings.hpp"
#include "landfall/error.hpp"
#include "landfall/match_scans.hpp"
#include "landfall/slam.hpp"

namespace landfall::python {
namespace nb = nanobind;
using namespace nb::literals;

namespace {

constexpr std::array matchers{std::pair{"pso", SlamMatcher::pso},
                              std::pair{"branch_and_bound", SlamMatcher::branch_and_bound}};
constexpr std::array predictions{std::pair{"still", SlamPrediction::still},
                                 std::pair{"constant_velocity", SlamPrediction::constant_velocity},
                                 std::pair{"odometry", SlamPrediction::odometry}};

template <class Names>
auto value_of(const Names& names, const std::string& name, const char* option) {
  std::string known;
  for (const auto& [text, value] : names) {
    if (name == text) return value;
    known += (known.empty() ? "" : ", ") + std::string(text);
  }
  throw Error(ErrorCode::unknown_name,
              std::string(option) + " is \"" + name + "\", expected one of " + known);
}

template <class Names, class Value>
std::string name_of(const Names& names, Value wanted) {
  for (const auto& [text, value] : names)
    if (value == wanted) return text;
  return {};
}

void bind_options(nb::module_& module) {
  nb::class_<SwarmOptions>(module, "SwarmOptions",
                           "The particle swarm; the defaults are the published values.")
      .def(nb::init<>())
      .def_rw("particles", &SwarmOptions::particles, "A quarter along x, a quarter along y, the rest turned.")
      .def_rw("iterations", &SwarmOptions::iterations)
      .def_rw("inertia", &SwarmOptions::inertia)
      .def_rw("own_pull", &SwarmOptions::own_pull)
      .def_rw("swarm_pull", &SwarmOptions::swarm_pull)
      .def_rw("good_enough", &SwarmOptions::good_enough, "The flight ends where f falls below.")
      .def_rw("reach_m", &SwarmOptions::reach_m, "Of the start pattern, to either side.")
      .def_rw("reach_rad", &SwarmOptions::reach_rad);

  nb::class_<SlamOptions>(module, "SlamOptions", "The options of slam(), with their defaults.")
      .def(nb::init<>())
      .def_prop_rw(
          "matcher", [](const SlamOptions& self) { return name_of(matchers, self.matcher); },
          [](SlamOptions& self, const std::string& name) {
            self.matcher = value_of(matchers, name, "matcher");
          },
          "\"pso\" or \"branch_and_bound\".")
      .def_prop_rw(
          "prediction", [](const SlamOptions& self) { return name_of(predictions, self.prediction); },
          [](SlamOptions& self, const std::string& name) {
            self.prediction = value_of(predictions, name, "prediction");
          },
          "\"still\", \"constant_velocity\" or \"odometry\".")
      .def_rw("swarm", &SlamOptions::swarm)
      .def_rw("refine", &SlamOptions::refine, "Matches are polished point to line; False: as published.")
      .def_rw("resolution_m", &SlamOptions::resolution_m)
      .def_rw("range_min_m", &SlamOptions::range_min_m, "Nearer echoes are left out.")
      .def_rw("range_max_m", &SlamOptions::range_max_m, "Farther echoes are left out; 0: no limit.")
      .def_rw("deletion_range_m", &SlamOptions::deletion_range_m,
              "Obstacles so near that the scanner sees through are deleted; 0: none.")
      .def_rw("least_agreement", &SlamOptions::least_agreement, "Of a match that is accepted.")
      .def_rw("recovery_reach_m", &SlamOptions::recovery_reach_m, "Of the wider search, any heading.")
      .def_rw("log_odds_hit", &SlamOptions::log_odds_hit)
      .def_rw("log_odds_miss", &SlamOptions::log_odds_miss)
      .def_rw("occupied_log_odds", &SlamOptions::occupied_log_odds)
      .def_rw("free_log_odds", &SlamOptions::free_log_odds)
      .def_rw("max_log_odds", &SlamOptions::max_log_odds)
      .def_rw("min_log_odds", &SlamOptions::min_log_odds)
      .def_rw("seed", &SlamOptions::seed)
      .def_rw("threads", &SlamOptions::threads);
}

void bind_step(nb::module_& module) {
  nb::class_<SlamStep>(module, "SlamStep", "What became of one scan.")
      .def_ro("T_map_robot", &SlamStep::T_map_robot, "Of a scan without match: as predicted.")
      .def_ro("accepted", &SlamStep::accepted, "It is part of the map.")
      .def_ro("recovered", &SlamStep::recovered, "By the wider search.")
      .def_ro("fit", &SlamStep::fit, "Share of the valid echoes in the map's cells: 1 - f.")
      .def_ro("agreement", &SlamStep::agreement,
              "Share, of the points that meet something known, that lie on walls.")
      .def_ro("cells_deleted", &SlamStep::cells_deleted, "Obstacle cells that were seen through.")
      .def_ro("match_ms", &SlamStep::match_ms)
      .def_ro("recovery_ms", &SlamStep::recovery_ms)
      .def_ro("insert_ms", &SlamStep::insert_ms);
}

constexpr std::array scan_matchers{std::pair{"icp", ScanMatcher::icp},
                                   std::pair{"icp_point_to_line", ScanMatcher::icp_point_to_line},
                                   std::pair{"angle_histogram", ScanMatcher::angle_histogram}};

void bind_match_scans(nb::module_& module) {
  const ScanMatchOptions defaults;
  module.def(
      "match_scans",
      [](const Scan& before, const Scan& after, const PoseArgument& T_before_start,
         const std::string& matcher, double range_min_m, double reach_m, double reach_rad, int iterations,
         double bin_m, double bin_rad) {
        const ScanMatchOptions options{.matcher = value_of(scan_matchers, matcher, "matcher"),
                                       .range_min_m = range_min_m,
                                       .reach_m = reach_m,
                                       .reach_rad = reach_rad,
                                       .iterations = iterations,
                                       .bin_m = bin_m,
                                       .bin_rad = bin_rad};
        const nb::gil_scoped_release released;
        return match_scans(before, after, T_before_start, options);
      },
      "before"_a, "after"_a, "T_before_start"_a = PoseArgument{}, nb::kw_only(), "matcher"_a = "icp",
      "range_min_m"_a = defaults.range_min_m, "reach_m"_a = defaults.reach_m,
      "reach_rad"_a = defaults.reach_rad, "iterations"_a = defaults.iterations, "bin_m"_a = defaults.bin_m,
      "bin_rad"_a = defaults.bin_rad,
      "T_before_after: where the later scan was taken, in the earlier one's robot frame, from a start near "
      "it.\n"
      "matcher: \"icp\", \"icp_point_to_line\" or \"angle_histogram\". Raises InvalidArgument, UnknownName.");
}

}  // namespace

void bind_slam(nb::module_& module) {
  bind_match_scans(module);
  bind_options(module);
  bind_step(module);
  nb::class_<Slam>(
      module, "Slam",
      "A map under construction: each scan is matched to the map so far (Okada & Fujimoto). The\n"
      "first scan founds it: its robot stands at (0, 0, 0).")
      .def(nb::init<const SlamOptions&>(), "options"_a = SlamOptions{})
      .def("add", &Slam::add, "scan"_a, nb::call_guard<nb::gil_scoped_release>(),
           "Matches the scan and, where it fits, adds it. Raises InvalidArgument, TooLarge.")
      .def("map", &Slam::map, nb::call_guard<nb::gil_scoped_release>(), "The cells known so far, a GridMap.")
      .def_prop_ro("memory_bytes", &Slam::memory_bytes);
}

}  // namespace landfall::python
