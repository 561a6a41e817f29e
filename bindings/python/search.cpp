// The search itself, and the log as a whole.
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include <chrono>
#include <future>
#include <stop_token>
#include <string>
#include <tuple>
#include <vector>

#include "arguments.hpp"
#include "arrays.hpp"
#include "bindings.hpp"
#include "landfall/consistent.hpp"
#include "landfall/search.hpp"
#include "repr.hpp"

namespace landfall::python {
namespace nb = nanobind;
using namespace nb::literals;

namespace {

void bind_options(nb::module_& module) {
  nb::class_<SearchOptions>(module, "SearchOptions", "The options of search(), with their defaults.")
      .def(nb::init<>())
      .def_rw("method", &SearchOptions::method, "A name of methods().")
      .def_rw("translation_step_m", &SearchOptions::translation_step_m,
              "0: the map's resolution; else a multiple of it.")
      .def_rw("rotation_step_rad", &SearchOptions::rotation_step_rad, "Between headings of the lattice.")
      .def_rw("max_hypotheses", &SearchOptions::max_hypotheses, "1 to 1000.")
      .def_rw("time_budget_s", &SearchOptions::time_budget_s, "Per scan; 0: none.")
      .def_rw("threads", &SearchOptions::threads, "0: all.")
      .def_rw("seed", &SearchOptions::seed, "Of methods that draw random numbers.")
      .def_rw("robot_radius_m", &SearchOptions::robot_radius_m, "A pose is possible where this disc is free.")
      .def_rw("distinct_translation_m", &SearchOptions::distinct_translation_m,
              "Hypotheses nearer than this and distinct_rotation_rad are one.")
      .def_rw("distinct_rotation_rad", &SearchOptions::distinct_rotation_rad)
      .def("__repr__", [](nb::handle self) {
        return repr_of(
            self, {"method", "translation_step_m", "rotation_step_rad", "max_hypotheses", "time_budget_s",
                   "threads", "seed", "robot_radius_m", "distinct_translation_m", "distinct_rotation_rad"});
      });
}

// A batch may take minutes, and Python acts on Ctrl-C only where somebody asks it to. A single scan is not
// worth the thread: a tracked one takes as long as starting it.
std::vector<SearchResult> search_interruptibly(const std::vector<PreparedMap>& maps,
                                               const std::vector<PosePrior>& priors,
                                               const std::vector<Scan>& scans, SearchOptions options) {
  if (scans.size() < 2) return search(maps, priors, scans, options);
  constexpr std::chrono::milliseconds between_looks{50};
  std::stop_source source;
  options.stop = source.get_token();
  std::future<std::vector<SearchResult>> answers =
      std::async(std::launch::async, [&] { return search(maps, priors, scans, options); });
  while (answers.wait_for(between_looks) != std::future_status::ready) {
    const nb::gil_scoped_acquire held;
    if (PyErr_CheckSignals() == 0) continue;
    source.request_stop();
    {
      const nb::gil_scoped_release released;
      answers.wait();
    }
    throw nb::python_error();
  }
  return answers.get();
}

}  // namespace

void bind_search(nb::module_& module) {
  bind_options(module);
  module.def(
      "search_batch",
      [](const std::vector<PreparedMap>& maps, const std::vector<PriorArgument>& given,
         const std::vector<Scan>& scans, const SearchOptions& options) {
        const std::vector<PosePrior> priors(given.begin(), given.end());
        return search_interruptibly(maps, priors, scans, options);
      },
      "maps"_a, "priors"_a, "scans"_a, "options"_a, nb::call_guard<nb::gil_scoped_release>(),
      "results[i] answers scans[i]; one prior for all scans, or one per scan. landfall.search() is the\n"
      "friendlier form.");

  const ConsistentOptions defaults;
  module.def(
      "consistent",
      [](const std::vector<SearchResult>& results, const PosesArgument& T_odom_robot,
         const OdometryNoise& odometry, double jump_probability) {
        const std::vector<Pose2> poses = poses_from(T_odom_robot, "consistent");
        const nb::gil_scoped_release released;
        return consistent(results, poses, {.odometry = odometry, .jump_probability = jump_probability});
      },
      "results"_a, "T_odom_robot"_a, nb::kw_only(), "odometry"_a = defaults.odometry,
      "jump_probability"_a = defaults.jump_probability,
      "Per result the index of the hypothesis that odometry ties to its neighbours' (Viterbi), or -1 where\n"
      "it has none. Raises InvalidArgument where the lengths differ.");

  module.def(
      "follow",
      [](const std::vector<PreparedMap>& maps, const std::vector<Scan>& scans,
         std::vector<SearchResult> results, const SearchOptions& options, const OdometryNoise& odometry,
         double jump_probability) {
        return follow(maps, scans, std::move(results), options,
                      {.odometry = odometry, .jump_probability = jump_probability});
      },
      "maps"_a, "scans"_a, "results"_a, "options"_a = SearchOptions{}, nb::kw_only(),
      "odometry"_a = defaults.odometry, "jump_probability"_a = defaults.jump_probability,
      nb::call_guard<nb::gil_scoped_release>(),
      "The results with more hypotheses: where a neighbour's probable ones and odometry place the robot, "
      "and\n"
      "none of the scan's own is near, the scan is asked again there. For consistent(). Raises\n"
      "InvalidArgument where the lengths differ or a scan has no T_odom_robot.");

  module.def(
      "polish",
      [](const std::vector<PreparedMap>& maps, const std::vector<Scan>& scans,
         const std::vector<SearchResult>& results, const std::vector<int>& choice, int threads,
         const OdometryNoise& odometry, double jump_probability) {
        return polish(maps, scans, results, choice,
                      {.odometry = odometry, .jump_probability = jump_probability}, threads);
      },
      "maps"_a, "scans"_a, "results"_a, "choice"_a, "threads"_a = 0, nb::kw_only(),
      "odometry"_a = defaults.odometry, "jump_probability"_a = defaults.jump_probability,
      nb::call_guard<nb::gil_scoped_release>(),
      "The results with the hypotheses that consistent() chose moved to where each scan and its neighbours,\n"
      "aligned, fit the map best together, and what the map explains from there; scores, covariances and\n"
      "probabilities stay, and so do composite scans. Raises InvalidArgument.");

  module.def(
      "methods",
      [] {
        std::vector<std::tuple<std::string, std::string, std::string>> rows;
        for (const MethodInfo& method : methods())
          rows.emplace_back(method.name, method.summary, method.source);
        return rows;
      },
      "The search methods: (name, summary, source) each.");
  module.def("active_isa", &active_isa,
             "The instruction set that the kernels run with. LANDFALL_ISA forces a lower one.");
  module.def("active_executor", &active_executor,
             "What schedules parallel work: \"tbb\", or \"openmp\" where LANDFALL_EXECUTOR says so.");
}

}  // namespace landfall::python
