// Pose2: immutable, a sequence (x_m, y_m, theta_rad), made from any such tuple.
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>

#include <cstdio>
#include <string>
#include <tuple>

#include "arguments.hpp"
#include "bindings.hpp"
#include "landfall/pose2.hpp"

namespace landfall::python {
namespace nb = nanobind;
using namespace nb::literals;

namespace {

std::string repr(const Pose2& pose) {
  char text[96];
  std::snprintf(text, sizeof text, "Pose2(x_m=%.4f, y_m=%.4f, theta_rad=%.5f)", pose.x_m, pose.y_m,
                pose.theta_rad);
  return text;
}

double component(const Pose2& pose, int i) {
  const int positive = i < 0 ? i + 3 : i;
  switch (positive) {
    case 0:
      return pose.x_m;
    case 1:
      return pose.y_m;
    case 2:
      return pose.theta_rad;
    default:
      throw nb::index_error("a Pose2 has three components");
  }
}

}  // namespace

void bind_poses(nb::module_& module) {
  nb::class_<Pose2>(module, "Pose2",
                    "A planar pose: metres, radians. Read as T_a_b it takes points of frame b into frame a; "
                    "T_a_b * T_b_c = T_a_c. A tuple (x, y, theta) is taken wherever a pose is expected.")
      .def(
          "__init__",
          [](Pose2* self, double x_m, double y_m, double theta_rad) {
            new (self) Pose2{x_m, y_m, theta_rad};
          },
          "x_m"_a = 0.0, "y_m"_a = 0.0, "theta_rad"_a = 0.0)
      .def("__init__", [](Pose2* self, const PoseArgument& pose) { new (self) Pose2(pose); })
      .def_ro("x_m", &Pose2::x_m)
      .def_ro("y_m", &Pose2::y_m)
      .def_ro("theta_rad", &Pose2::theta_rad)
      .def("inverse", &inverse, "T_b_a of T_a_b.")
      .def(
          "__mul__", [](const Pose2& T_a_b, const Pose2& T_b_c) { return T_a_b * T_b_c; }, nb::is_operator())
      .def(
          "__eq__", [](const Pose2& a, const Pose2& b) { return a == b; }, nb::is_operator(),
          nb::sig("def __eq__(self, arg: object, /) -> bool"))
      .def("__hash__",
           [](const Pose2& pose) { return nb::hash(nb::make_tuple(pose.x_m, pose.y_m, pose.theta_rad)); })
      .def("__len__", [](const Pose2&) { return 3; })
      .def("__getitem__", &component)
      .def(
          "__iter__",
          [](const Pose2& pose) { return nb::iter(nb::make_tuple(pose.x_m, pose.y_m, pose.theta_rad)); },
          nb::sig("def __iter__(self) -> collections.abc.Iterator[float]"))
      .def("__getstate__",
           [](const Pose2& pose) { return std::make_tuple(pose.x_m, pose.y_m, pose.theta_rad); })
      .def("__setstate__",
           [](Pose2& self, const std::tuple<double, double, double>& s) {
             new (&self) Pose2{std::get<0>(s), std::get<1>(s), std::get<2>(s)};
           })
      .def("__repr__", &repr);

  module.def("wrap_angle", &wrap_angle, "angle_rad"_a, "The same direction in (-pi, pi].");
  module.def("angle_distance", &angle_distance, "a_rad"_a, "b_rad"_a, "|wrap(a - b)|, in [0, pi].");
  module.def("translation_distance", &translation_distance, "a"_a, "b"_a,
             "Euclidean distance of the positions, metres.");
}

}  // namespace landfall::python
