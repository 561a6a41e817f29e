// landfall._landfall: the engine's nouns and functions as they are in C++. The package around it
// (landfall/__init__.py) adds the keyword options, ROS bags, pictures and the command.
#include "bindings.hpp"

NB_MODULE(_landfall, module) {
  using namespace landfall::python;
  module.attr("__doc__") =
      "The landfall engine: maps, scans, priors, search. Metres, radians, REP-103 frames.";
  // The library never prints: what Python's caches (tracebacks, typing) still hold at exit is no leak.
  nanobind::set_leak_warnings(false);
  bind_errors();
  bind_poses(module);
  bind_maps(module);
  bind_scans(module);
  bind_priors(module);
  bind_results(module);
  bind_search(module);
  bind_slam(module);
  bind_correlation(module);
  bind_timing(module);
  bind_diffusion(module);
  bind_logs(module);
  bind_sonar_mapping(module);
  bind_files(module);
}
