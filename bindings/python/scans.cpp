// Beam, Sensor, Scan, and what is made of them: fans, composite scans, aligned windows.
#include <nanobind/stl/optional.h>
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <algorithm>
#include <memory>
#include <string>

#include "arguments.hpp"
#include "arrays.hpp"
#include "bindings.hpp"
#include "landfall/align.hpp"
#include "landfall/error.hpp"
#include "landfall/scan.hpp"
#include "landfall/sensor.hpp"
#include "repr.hpp"

namespace landfall::python {
namespace nb = nanobind;
using namespace nb::literals;

namespace {

using SensorPtr = std::shared_ptr<const Sensor>;

std::vector<float> copy_ranges(const ArrayLike<float>& ranges) {
  return {ranges.array.data(), ranges.array.data() + ranges.array.size()};
}

void init_scan(Scan* self, SensorPtr sensor, const ArrayLike<float>& ranges_m, double stamp_s,
               std::optional<PoseArgument> T_odom_robot, std::optional<PoseArgument> T_map_robot,
               const std::optional<Scan>& measured) {
  Scan scan{.sensor = std::move(sensor),
            .ranges_m = copy_ranges(ranges_m),
            .stamp_s = stamp_s,
            .T_odom_robot = T_odom_robot,
            .T_map_robot = T_map_robot,
            .measured = measured ? std::make_shared<const Scan>(*measured) : nullptr};
  validate(scan);
  new (self) Scan(std::move(scan));
}

Vector<float> ranges_of(nb::handle self) {
  Scan& scan = nb::cast<Scan&>(self);
  return view(scan.ranges_m.data(), scan.ranges_m.size(), self);
}

// In place, so that views of the ranges stay valid.
void assign_ranges(Scan& scan, const ArrayLike<float>& ranges) {
  if (ranges.array.size() != scan.ranges_m.size()) {
    throw Error(ErrorCode::invalid_argument, "Scan.ranges_m: " + std::to_string(ranges.array.size()) +
                                                 " values, expected one per beam (" +
                                                 std::to_string(scan.ranges_m.size()) + ")");
  }
  std::copy_n(ranges.array.data(), ranges.array.size(), scan.ranges_m.begin());
}

// End points of the echoes in the robot frame, row by row.
Matrix<double> points_robot(const Scan& scan) {
  std::vector<double> points;
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    const Beam& beam = scan.sensor->beams[i];
    if (classify(beam, scan.ranges_m[i]) != Reading::echo) continue;
    const Point2 p_robot = beam.T_robot_beam * Point2{scan.ranges_m[i], 0.0};
    points.insert(points.end(), {p_robot.x_m, p_robot.y_m});
  }
  const std::size_t rows = points.size() / 2;
  return adopt(std::move(points), rows, 2);
}

void bind_sensor(nb::module_& module) {
  const Beam beam;
  nb::class_<Beam>(module, "Beam", "One beam of a sensor: mount pose in the robot frame, half-angle, limits.")
      .def(
          "__init__",
          [](Beam* self, const PoseArgument& T_robot_beam, double half_angle_rad, double range_min_m,
             double range_max_m) {
            new (self) Beam{T_robot_beam, half_angle_rad, range_min_m, range_max_m};
          },
          "T_robot_beam"_a = PoseArgument{}, "half_angle_rad"_a = beam.half_angle_rad,
          "range_min_m"_a = beam.range_min_m, "range_max_m"_a = beam.range_max_m)
      .def_ro("T_robot_beam", &Beam::T_robot_beam)
      .def_ro("half_angle_rad", &Beam::half_angle_rad, "0: a ray; a cone of 12 degrees has 6 here.")
      .def_ro("range_min_m", &Beam::range_min_m, "A shorter reading is invalid.")
      .def_ro("range_max_m", &Beam::range_max_m, "This or more means that nothing was hit.")
      .def("__repr__", [](nb::handle self) {
        return repr_of(self, {"T_robot_beam", "half_angle_rad", "range_min_m", "range_max_m"});
      });

  const Sensor sensor;
  nb::class_<Sensor>(module, "Sensor", "A named list of beams with its noise; immutable.")
      .def(
          "__init__",
          [](Sensor* self, std::vector<Beam> beams, std::string name, double range_noise_m,
             double range_noise_relative) {
            Sensor made{std::move(name), std::move(beams), range_noise_m, range_noise_relative};
            validate(made);
            new (self) Sensor(std::move(made));
          },
          "beams"_a, "name"_a = "sensor", "range_noise_m"_a = sensor.range_noise_m,
          "range_noise_relative"_a = sensor.range_noise_relative,
          "Noise: one sigma, the constant part and the part that grows with the range. Raises "
          "InvalidArgument.")
      .def_ro("name", &Sensor::name)
      .def_ro("beams", &Sensor::beams)
      .def_ro("range_noise_m", &Sensor::range_noise_m)
      .def_ro("range_noise_relative", &Sensor::range_noise_relative)
      .def("__len__", [](const Sensor& self) { return self.beams.size(); })
      .def("__repr__", [](const Sensor& self) {
        return "Sensor(name='" + self.name + "', " + std::to_string(self.beams.size()) + " beams)";
      });

  const FanOptions fan;
  module.def(
      "make_fan",
      [](int beams, double first_rad, double step_rad, const std::string& name,
         const PoseArgument& T_robot_sensor, double half_angle_rad, double range_min_m, double range_max_m,
         double range_noise_m, double range_noise_relative) {
        return make_fan({.name = name,
                         .beams = beams,
                         .first_rad = first_rad,
                         .step_rad = step_rad,
                         .T_robot_sensor = T_robot_sensor,
                         .half_angle_rad = half_angle_rad,
                         .range_min_m = range_min_m,
                         .range_max_m = range_max_m,
                         .range_noise_m = range_noise_m,
                         .range_noise_relative = range_noise_relative});
      },
      "beams"_a, "first_rad"_a, "step_rad"_a, nb::kw_only(), "name"_a = fan.name,
      "T_robot_sensor"_a = PoseArgument{fan.T_robot_sensor}, "half_angle_rad"_a = fan.half_angle_rad,
      "range_min_m"_a = fan.range_min_m, "range_max_m"_a = fan.range_max_m,
      "range_noise_m"_a = fan.range_noise_m, "range_noise_relative"_a = fan.range_noise_relative,
      "An evenly spaced fan: beam i points to first_rad + i * step_rad in the mount's frame.");
}

void bind_scan(nb::module_& module) {
  nb::class_<Scan>(module, "Scan", "What a sensor saw at one time: one range per beam.")
      .def("__init__", &init_scan, "sensor"_a, "ranges_m"_a, "stamp_s"_a = 0.0, "T_odom_robot"_a = nb::none(),
           "T_map_robot"_a = nb::none(), "measured"_a = nb::none(),
           "ranges_m: (beams,) float32; NaN is invalid, at or above the beam's range_max_m nothing was hit.\n"
           "T_odom_robot: odometry. T_map_robot: a pose recorded in the log; search never looks at it.\n"
           "measured: the readings that the scan was condensed from, by which search judges as well.\n"
           "Raises InvalidArgument.")
      .def_prop_ro("sensor", [](const Scan& scan) { return scan.sensor; })
      .def_prop_rw("ranges_m", &ranges_of, &assign_ranges, "(beams,) float32, a writable view without copy.")
      .def_rw("stamp_s", &Scan::stamp_s)
      .def_prop_rw(
          "T_odom_robot", [](const Scan& scan) { return scan.T_odom_robot; },
          [](Scan& scan, std::optional<PoseArgument> pose) { scan.T_odom_robot = pose; }, nb::arg().none())
      .def_prop_rw(
          "T_map_robot", [](const Scan& scan) { return scan.T_map_robot; },
          [](Scan& scan, std::optional<PoseArgument> pose) { scan.T_map_robot = pose; }, nb::arg().none())
      .def_prop_ro(
          "measured",
          [](const Scan& scan) { return scan.measured ? std::optional<Scan>(*scan.measured) : std::nullopt; },
          "A copy of the readings that the scan was condensed from (merge_turn_minima), or None.")
      .def("points_robot", &points_robot,
           "(echoes, 2) float64: where the beams that hit something ended, in the robot frame.")
      .def("count_valid", &count_valid)
      .def("count_echoes", &count_echoes)
      .def("__len__", [](const Scan& scan) { return scan.ranges_m.size(); })
      .def("__repr__", [](const Scan& scan) {
        return "Scan(stamp_s=" + std::to_string(scan.stamp_s) + ", " + std::to_string(scan.ranges_m.size()) +
               " beams, sensor='" + scan.sensor->name + "')";
      });

  nb::class_<RelativePoseNoise>(module, "RelativePoseNoise",
                                "How far relative poses may be off: one sigma between consecutive scans.")
      .def(
          "__init__",
          [](RelativePoseNoise* self, double translation_m, double rotation_rad) {
            new (self) RelativePoseNoise{.translation_m = translation_m, .rotation_rad = rotation_rad};
          },
          nb::kw_only(), "translation_m"_a = 0.0, "rotation_rad"_a = 0.0)
      .def_ro("translation_m", &RelativePoseNoise::translation_m)
      .def_ro("rotation_rad", &RelativePoseNoise::rotation_rad);
  module.attr("ALIGNED_NOISE") = aligned_noise;

  module.def(
      "merge",
      [](const std::vector<Scan>& scans, const std::optional<PosesArgument>& T_common_robot,
         std::optional<std::size_t> reference, const RelativePoseNoise& noise) {
        const std::vector<Pose2> poses =
            T_common_robot ? poses_from(*T_common_robot, "merge") : odometry_of(scans);
        const nb::gil_scoped_release released;
        return merge(scans, poses, reference.value_or(scans.empty() ? 0 : scans.size() - 1), noise);
      },
      "scans"_a, "T_common_robot"_a = nb::none(), "reference"_a = nb::none(), "noise"_a = RelativePoseNoise{},
      "One scan with the beams of all, seen from scan `reference` (the last by default) and under its "
      "stamp.\n"
      "T_common_robot: where each was taken, in any common frame; without it, the scans' own odometry.\n"
      "noise: how far these may be off (ALIGNED_NOISE for those of align): search then has every scan where\n"
      "it fits the map best within that. Zero: as given.\n"
      "Raises InvalidArgument.");
}

void bind_align(nb::module_& module) {
  const OdometryNoise noise;
  nb::class_<OdometryNoise>(module, "OdometryNoise", "One sigma of odometry's error between two scans.")
      .def(
          "__init__",
          [](OdometryNoise* self, double translation_m, double translation_relative,
             double translation_per_rad_m, double rotation_rad, double rotation_per_m_rad,
             double rotation_relative) {
            new (self) OdometryNoise{.translation_m = translation_m,
                                     .translation_relative = translation_relative,
                                     .translation_per_rad_m = translation_per_rad_m,
                                     .rotation_rad = rotation_rad,
                                     .rotation_per_m_rad = rotation_per_m_rad,
                                     .rotation_relative = rotation_relative};
          },
          nb::kw_only(), "translation_m"_a = noise.translation_m,
          "translation_relative"_a = noise.translation_relative,
          "translation_per_rad_m"_a = noise.translation_per_rad_m, "rotation_rad"_a = noise.rotation_rad,
          "rotation_per_m_rad"_a = noise.rotation_per_m_rad, "rotation_relative"_a = noise.rotation_relative)
      .def_rw("translation_m", &OdometryNoise::translation_m, "Constant part.")
      .def_rw("translation_relative", &OdometryNoise::translation_relative, "Per metre driven.")
      .def_rw("translation_per_rad_m", &OdometryNoise::translation_per_rad_m, "Per radian turned.")
      .def_rw("rotation_rad", &OdometryNoise::rotation_rad, "Constant part.")
      .def_rw("rotation_per_m_rad", &OdometryNoise::rotation_per_m_rad, "Per metre driven.")
      .def_rw("rotation_relative", &OdometryNoise::rotation_relative, "Per radian turned.");

  const AlignOptions options;
  module.def(
      "align",
      [](const std::vector<Scan>& scans, std::optional<std::size_t> reference, const OdometryNoise& odometry,
         double resolution_m, int threads) {
        const nb::gil_scoped_release released;
        return align(scans, reference.value_or(scans.empty() ? 0 : scans.size() - 1),
                     {.odometry = odometry, .resolution_m = resolution_m, .threads = threads});
      },
      "scans"_a, "reference"_a = nb::none(), nb::kw_only(), "odometry"_a = noise,
      "resolution_m"_a = options.resolution_m, "threads"_a = options.threads,
      "T_reference_robot of each scan (the last by default): odometry's relative poses, polished by "
      "matching\n"
      "the scans to each other, within three sigma of odometry. Raises InvalidArgument.");
}

}  // namespace

void bind_scans(nb::module_& module) {
  bind_sensor(module);
  bind_scan(module);
  bind_align(module);
}

}  // namespace landfall::python
