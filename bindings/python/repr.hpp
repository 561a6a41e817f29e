// What interactive users see of plain values.
#pragma once

#include <nanobind/nanobind.h>

#include <initializer_list>

namespace landfall::python {

// "Window(T_map_robot=Pose2(...), half_x_m=0.5)": the attributes by name, each as Python shows it.
nanobind::str repr_of(nanobind::handle self, std::initializer_list<const char*> attributes);

}  // namespace landfall::python
