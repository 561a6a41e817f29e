// Priors: where to look. Each kind is a class of its own; a function that takes a prior takes any.
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include <algorithm>
#include <span>
#include <tuple>
#include <vector>

#include "arguments.hpp"
#include "arrays.hpp"
#include "bindings.hpp"
#include "landfall/error.hpp"
#include "landfall/prior.hpp"
#include "repr.hpp"

namespace landfall::python {
namespace nb = nanobind;
using namespace nb::literals;

namespace {

// What a caller hands over is checked where it is made, so that the message points there.
template <class Kind>
void init_checked(Kind* self, Kind kind) {
  validate(PosePrior{kind});
  new (self) Kind(std::move(kind));
}

Gaussian gaussian_from_sigmas(const Pose2& T_map_robot, double sigma_xy_m, double sigma_theta_rad) {
  const double xy = sigma_xy_m * sigma_xy_m;
  return {T_map_robot, {xy, 0, 0, 0, xy, 0, 0, 0, sigma_theta_rad * sigma_theta_rad}};
}

Gaussian gaussian_from_matrix(const Pose2& T_map_robot, const ArrayLike<double>& covariance) {
  const std::span<const double> values(covariance.array.data(), covariance.array.size());
  if (shape_of(covariance) != std::vector<std::size_t>{3, 3}) {
    throw Error(ErrorCode::invalid_argument, "Gaussian covariance: an array of shape " +
                                                 shape_text(shape_of(covariance)) + ", expected (3, 3)");
  }
  Gaussian gaussian{.T_map_robot = T_map_robot, .covariance = {}};
  std::copy(values.begin(), values.end(), gaussian.covariance.begin());
  return gaussian;
}

Matrix<const double> covariance_of(nb::handle self) {
  return view(static_cast<const double*>(nb::cast<const Gaussian&>(self).covariance.data()), 3, 3, self);
}

void bind_boxes(nb::module_& module) {
  const Window window;
  nb::class_<Anywhere>(module, "Anywhere", "Everywhere that is free, any heading.")
      .def(nb::init<>())
      .def("__repr__", [](nb::handle self) { return repr_of(self, {}); });
  nb::class_<Window>(module, "Window",
                     "A box in x and y, aligned with the map's axes, and a cone in heading.")
      .def(
          "__init__",
          [](Window* self, const PoseArgument& T_map_robot, double half_x_m, double half_y_m,
             double half_theta_rad) {
            init_checked(self, Window{T_map_robot, half_x_m, half_y_m, half_theta_rad});
          },
          "T_map_robot"_a, "half_x_m"_a = window.half_x_m, "half_y_m"_a = window.half_y_m,
          "half_theta_rad"_a = window.half_theta_rad,
          "T_map_robot: the middle. Half widths in metres and radians; by default any heading. Raises\n"
          "InvalidArgument.")
      .def_ro("T_map_robot", &Window::T_map_robot)
      .def_ro("half_x_m", &Window::half_x_m)
      .def_ro("half_y_m", &Window::half_y_m)
      .def_ro("half_theta_rad", &Window::half_theta_rad)
      .def("__repr__", [](nb::handle self) {
        return repr_of(self, {"T_map_robot", "half_x_m", "half_y_m", "half_theta_rad"});
      });
  nb::class_<Gaussian>(module, "Gaussian", "A Gaussian of (x_m, y_m, theta_rad); its support is three sigma.")
      .def(
          "__init__",
          [](Gaussian* self, const PoseArgument& T_map_robot, const ArrayLike<double>& covariance) {
            init_checked(self, gaussian_from_matrix(T_map_robot, covariance));
          },
          "T_map_robot"_a, "covariance"_a,
          "T_map_robot: the mean. covariance: (3, 3) of (x_m, y_m, theta_rad), map frame; symmetric, "
          "positive\n"
          "semi-definite. Raises InvalidArgument.")
      .def(
          "__init__",
          [](Gaussian* self, const PoseArgument& T_map_robot, double sigma_xy_m, double sigma_theta_rad) {
            init_checked(self, gaussian_from_sigmas(T_map_robot, sigma_xy_m, sigma_theta_rad));
          },
          "T_map_robot"_a, nb::kw_only(), "sigma_xy_m"_a, "sigma_theta_rad"_a,
          "Without correlation: one sigma of x and of y, metres, and of the heading, radians.")
      .def_ro("T_map_robot", &Gaussian::T_map_robot)
      .def_prop_ro("covariance", &covariance_of, "(3, 3) float64, read-only view.")
      .def("__repr__", [](nb::handle self) {
        return repr_of(self, {"T_map_robot", "covariance"});
      });
}

void bind_areas(nb::module_& module) {
  const Region region;
  nb::class_<Region>(module, "Region", "A simple polygon; any heading or a cone of headings.")
      .def(
          "__init__",
          [](Region* self, const ArrayLike<double>& polygon, double theta_rad, double half_theta_rad) {
            init_checked(self, Region{points_from(polygon, "Region"), theta_rad, half_theta_rad});
          },
          "polygon_map"_a, "theta_rad"_a = region.theta_rad, "half_theta_rad"_a = region.half_theta_rad,
          "polygon_map: (n, 2) corners, metres, map frame. Headings within half_theta_rad of theta_rad, by\n"
          "default any. Raises InvalidArgument.")
      .def_prop_ro("polygon_map",
                   [](const Region& self) {
                     std::vector<std::tuple<double, double>> corners;
                     for (const Point2& p : self.polygon_map) corners.emplace_back(p.x_m, p.y_m);
                     return corners;
                   })
      .def_ro("theta_rad", &Region::theta_rad)
      .def_ro("half_theta_rad", &Region::half_theta_rad)
      .def("__repr__", [](nb::handle self) {
        return repr_of(self, {"polygon_map", "theta_rad", "half_theta_rad"});
      });

  nb::class_<Beacons>(module, "Beacons", "The robot is within a radius of one of some points; any heading.")
      .def(
          "__init__",
          [](Beacons* self, const ArrayLike<double>& rows) {
            const std::span<const double> values = rows_of(rows, 3, "Beacons");
            Beacons made;
            for (std::size_t i = 0; i < values.size(); i += 3) {
              made.discs.push_back({{values[i], values[i + 1]}, values[i + 2]});
            }
            init_checked(self, std::move(made));
          },
          "discs"_a, "discs: (n, 3): x_m, y_m, radius_m, map frame. Raises InvalidArgument.")
      .def_prop_ro("discs",
                   [](const Beacons& self) {
                     std::vector<std::tuple<double, double, double>> discs;
                     for (const Beacon& b : self.discs)
                       discs.emplace_back(b.p_map.x_m, b.p_map.y_m, b.radius_m);
                     return discs;
                   })
      .def("__repr__", [](nb::handle self) { return repr_of(self, {"discs"}); });
}

void bind_lists(nb::module_& module) {
  nb::class_<CandidatePoses>(module, "CandidatePoses", "Each pose stands for the lattice pose nearest to it.")
      .def(
          "__init__",
          [](CandidatePoses* self, const PosesArgument& poses) {
            init_checked(self, CandidatePoses{poses_from(poses, "CandidatePoses")});
          },
          "T_map_robot"_a, "T_map_robot: a list of poses, or an array (n, 3). Raises InvalidArgument.")
      .def_ro("T_map_robot", &CandidatePoses::T_map_robot)
      .def("__repr__", [](nb::handle self) { return repr_of(self, {"T_map_robot"}); });
}

void bind_mixture(nb::module_& module) {
  // Declared first: Mixture takes it.
  nb::class_<PosePrior> prior(module, "PosePrior", "A prior of any kind.");
  nb::class_<Mixture>(module, "Mixture",
                      "Weighted priors. Weights multiply the likelihood in `probability`, never `score`.")
      .def(
          "__init__",
          [](Mixture* self, std::vector<double> weights, const std::vector<PriorArgument>& components) {
            init_checked(self, Mixture{std::move(weights), {components.begin(), components.end()}});
          },
          "weights"_a, "components"_a,
          "One weight, 0 or more, per component; they need not sum to 1. Raises InvalidArgument.")
      .def_ro("weights", &Mixture::weights)
      .def_prop_ro("components", [](const Mixture& self) { return self.components; })
      .def("__repr__", [](nb::handle self) {
        return repr_of(self, {"weights", "components"});
      });
  prior.def("__init__", [](PosePrior* self, const PriorArgument& kind) { new (self) PosePrior(kind); })
      .def_prop_ro("kind",
                   [](const PosePrior& self) {
                     return std::visit([](const auto& kind) { return nb::cast(kind); }, self.kind);
                   })
      .def("__repr__", [](nb::handle self) { return repr_of(self, {"kind"}); });
}

}  // namespace

void bind_priors(nb::module_& module) {
  bind_boxes(module);
  bind_areas(module);
  bind_lists(module);
  bind_mixture(module);
}

}  // namespace landfall::python
