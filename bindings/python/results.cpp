// Hypothesis, SearchResult and what a result counts and times.
#include <nanobind/stl/string.h>
#include <nanobind/stl/string_view.h>
#include <nanobind/stl/vector.h>

#include <cstdio>
#include <string>

#include "arrays.hpp"
#include "bindings.hpp"
#include "landfall/io.hpp"
#include "landfall/search.hpp"
#include "repr.hpp"

namespace landfall::python {
namespace nb = nanobind;
using namespace nb::literals;

namespace {

Matrix<const double> covariance_of(nb::handle self) {
  return view(static_cast<const double*>(nb::cast<const Hypothesis&>(self).covariance.data()), 3, 3, self);
}

std::string repr(const Hypothesis& h) {
  char text[160];
  std::snprintf(
      text, sizeof text,
      "Hypothesis(x_m=%.3f, y_m=%.3f, theta_rad=%.4f, score=%lld, explained=%.3f, probability=%.3f)",
      h.T_map_robot.x_m, h.T_map_robot.y_m, h.T_map_robot.theta_rad, static_cast<long long>(h.score),
      h.explained, h.probability);
  return text;
}

void bind_hypothesis(nb::module_& module) {
  nb::class_<Hypothesis>(module, "Hypothesis", "One place where the robot may have been.")
      .def_ro("T_map_robot", &Hypothesis::T_map_robot, "Refined below the grid step.")
      .def_ro("T_map_robot_unrefined", &Hypothesis::T_map_robot_unrefined, "The method's own answer.")
      .def_ro("score", &Hypothesis::score, "The method's own integer score.")
      .def_ro("explained", &Hypothesis::explained, "Share of valid beams that the map explains, 0..1.")
      .def_ro("probability", &Hypothesis::probability, "The mode's posterior mass over the prior's domain.")
      .def_prop_ro("covariance", &covariance_of,
                   "(3, 3) float64 of (x_m, y_m, theta_rad) in the map frame, read-only view.")
      .def_ro("map_index", &Hypothesis::map_index, "Which of the maps given.")
      .def("__repr__", &repr);
}

void bind_numbers(nb::module_& module) {
  nb::class_<StageTimes>(module, "StageTimes", "Wall time of each stage of a query, milliseconds.")
      .def_ro("prepare_ms", &StageTimes::prepare_ms, "Building what the map lacked: the first query only.")
      .def_ro("propose_ms", &StageTimes::propose_ms, "The search method.")
      .def_ro("refine_ms", &StageTimes::refine_ms, "Below the grid step.")
      .def_ro("verify_ms", &StageTimes::verify_ms, "Casting rays.")
      .def_ro("rank_ms", &StageTimes::rank_ms, "Probability and verdict.")
      .def_ro("total_ms", &StageTimes::total_ms, "Of the whole query.")
      .def("__repr__", [](nb::handle self) {
        return repr_of(self, {"prepare_ms", "propose_ms", "refine_ms", "verify_ms", "rank_ms", "total_ms"});
      });
  nb::class_<SearchCounts>(module, "SearchCounts", "What a search looked at.")
      .def_ro("poses_covered", &SearchCounts::poses_covered, "Free lattice poses of the prior.")
      .def_ro("poses_scored", &SearchCounts::poses_scored,
              "Of these, scored one by one; bounds excluded the others.")
      .def_ro("bounds_computed", &SearchCounts::bounds_computed, "Bounds over many poses each.")
      .def_ro("rays_cast", &SearchCounts::rays_cast, "Simulated ranges, to verify.")
      .def("__repr__", [](nb::handle self) {
        return repr_of(self, {"poses_covered", "poses_scored", "bounds_computed", "rays_cast"});
      });
}

}  // namespace

void bind_results(nb::module_& module) {
  bind_hypothesis(module);
  bind_numbers(module);
  nb::class_<SearchResult>(module, "SearchResult", "The answer to one scan.")
      .def_ro("hypotheses", &SearchResult::hypotheses, "Ranked and distinct; empty if nothing to go by.")
      .def_prop_ro(
          "verdict", [](const SearchResult& self) { return to_string(self.verdict); },
          "'found', 'ambiguous' or 'lost'.")
      .def_ro("reason", &SearchResult::reason, "Why lost; empty otherwise.")
      .def_ro("proven", &SearchResult::proven, "No lattice pose of the prior scores higher.")
      .def_ro("method", &SearchResult::method, "Which answered, with its instruction set.")
      .def_ro("beams_valid", &SearchResult::beams_valid, "Readings that are not invalid.")
      .def_ro("beams_echo", &SearchResult::beams_echo, "Of these, the ones that hit something.")
      .def_ro("stamp_s", &SearchResult::stamp_s, "The scan's time stamp.")
      .def_ro("counts", &SearchResult::counts, "What was looked at.")
      .def_ro("times", &SearchResult::times, "Milliseconds of each stage.")
      .def(
          "to_json", [](const SearchResult& self, std::size_t index) { return to_json_line(self, index); },
          "index"_a = 0, "A results.jsonl line, without the line end.")
      .def("__repr__", [](const SearchResult& self) {
        const std::string text = "SearchResult(verdict='" + std::string(to_string(self.verdict)) + "', ";
        if (self.hypotheses.empty()) return text + "no hypothesis: " + self.reason + ")";
        return text + std::to_string(self.hypotheses.size()) + " hypotheses, best " +
               repr(self.hypotheses.front()) + ")";
      });
}

}  // namespace landfall::python
