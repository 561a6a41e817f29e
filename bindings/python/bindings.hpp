// The parts of the module, one per file; module.cpp calls them in this order.
#pragma once

#include <nanobind/nanobind.h>

namespace landfall::python {

void bind_errors();
void bind_poses(nanobind::module_& module);
void bind_maps(nanobind::module_& module);
void bind_scans(nanobind::module_& module);
void bind_priors(nanobind::module_& module);
void bind_results(nanobind::module_& module);
void bind_search(nanobind::module_& module);
void bind_slam(nanobind::module_& module);
void bind_correlation(nanobind::module_& module);
void bind_timing(nanobind::module_& module);
void bind_diffusion(nanobind::module_& module);
void bind_logs(nanobind::module_& module);
void bind_sonar_mapping(nanobind::module_& module);
void bind_files(nanobind::module_& module);

}  // namespace landfall::python
