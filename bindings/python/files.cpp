// Readers and writers; their errors name file, line, field and value.
#include <nanobind/stl/filesystem.h>
#include <nanobind/stl/map.h>
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <tuple>
#include <vector>

#include "arguments.hpp"
#include "bindings.hpp"
#include "landfall/io.hpp"

namespace landfall::python {
namespace nb = nanobind;
using namespace nb::literals;

namespace {

using Path = std::filesystem::path;
using Sensors = std::map<std::string, std::shared_ptr<const Sensor>>;

void bind_map_files(nb::module_& module) {
  const LoadMapOptions defaults;
  module.def(
      "load_map",
      [](const Path& path, double field_sigma_m, const std::string& name, double resolution_m) {
        const nb::gil_scoped_release released;
        return load_map(path, {.walls = {.resolution_m = resolution_m},
                               .prepare = {.field_sigma_m = field_sigma_m, .name = name}});
      },
      "path"_a, nb::kw_only(), "field_sigma_m"_a = defaults.prepare.field_sigma_m, "name"_a = "",
      "resolution_m"_a = defaults.walls.resolution_m,
      "A ROS map (.yaml with its image) or a wall plan (.json), ready to search.\n"
      "name: by default the file's without its ending, or its folder's where that is plain \"map\".\n"
      "resolution_m: of the grid that a plan is searched on. field_sigma_m: how far from a wall an echo may\n"
      "lie and still count. Raises FileNotFound, FileFormat, TooLarge.");
  module.def("load_grid_map", &load_grid_map, "yaml"_a, nb::call_guard<nb::gil_scoped_release>(),
             "A ROS map_server yaml with its image. Raises FileNotFound, FileFormat, TooLarge.");
  module.def("save_grid_map", &save_grid_map, "map"_a, "yaml"_a, nb::call_guard<nb::gil_scoped_release>(),
             "Writes the yaml and, beside it, a pgm; an existing file is replaced whole. Raises FileWrite.");
  module.def("load_wall_map", &load_wall_map, "json"_a, nb::call_guard<nb::gil_scoped_release>(),
             "{\"units\": \"m\", \"walls\": [[x1, y1, x2, y2], ...]}. Raises FileNotFound, FileFormat.");
  module.def("save_wall_map", &save_wall_map, "map"_a, "json"_a, nb::call_guard<nb::gil_scoped_release>(),
             "A wall plan as JSON, metres. Raises FileWrite.");
}

void bind_log_files(nb::module_& module) {
  nb::class_<Log>(module, "Log", "The scans of a log, and what was passed over.")
      .def(
          "__init__",
          [](Log* self, std::vector<Scan> scans, std::vector<std::string> warnings) {
            new (self) Log{std::move(scans), std::move(warnings)};
          },
          "scans"_a, "warnings"_a = std::vector<std::string>{})
      .def_ro("scans", &Log::scans)
      .def_ro("warnings", &Log::warnings, "Lines that were passed over, with file and line.")
      .def("__len__", [](const Log& self) { return self.scans.size(); })
      .def("__repr__",
           [](const Log& self) { return "Log(" + std::to_string(self.scans.size()) + " scans)"; });
  module.def("load_sensors", &load_sensors, "path"_a, nb::call_guard<nb::gil_scoped_release>(),
             "The sensors that a yaml or a .jsonl log defines, by name. Raises FileNotFound, FileFormat.");
  module.def("save_sensor", &save_sensor, "sensor"_a, "yaml"_a, nb::call_guard<nb::gil_scoped_release>(),
             "A sensor as yaml, as load_sensors() and --sensor read it. Raises FileWrite.");
  module.def(
      "load_text_log",
      [](const Path& path, const Sensors& sensors) {
        const nb::gil_scoped_release released;
        return load_log(path, {.sensors = sensors});
      },
      "path"_a, "sensors"_a = Sensors{},
      "CARMEN text, scan lines or a sonar table; landfall.load_log() reads ROS bags too.\n"
      "sensors: replaces what the log implies, by the log's own names. Raises FileNotFound, FileFormat.");
  module.def(
      "save_log", [](const std::vector<Scan>& scans, const Path& jsonl) { save_log(scans, jsonl); },
      "scans"_a, "jsonl"_a, nb::call_guard<nb::gil_scoped_release>(), "Scan lines. Raises FileWrite.");
}

void bind_pose_files(nb::module_& module) {
  module.def(
      "load_trajectory",
      [](const Path& tum) {
        std::vector<std::tuple<double, Pose2>> poses;
        for (const StampedPose& stamped : load_trajectory(tum))
          poses.emplace_back(stamped.stamp_s, stamped.pose);
        return poses;
      },
      "tum"_a, "(stamp_s, pose) of each line, seconds and Pose2. Raises FileNotFound, FileFormat.");
  module.def(
      "save_trajectory",
      [](const std::vector<std::tuple<double, PoseArgument>>& poses, const Path& tum) {
        std::vector<StampedPose> stamped;
        stamped.reserve(poses.size());
        for (const auto& [stamp_s, pose] : poses) stamped.push_back({stamp_s, pose});
        save_trajectory(stamped, tum);
      },
      "poses"_a, "tum"_a, "poses: (stamp_s, pose) each. Raises FileWrite.");
  module.def("load_places", &load_places, "yaml"_a,
             "Named places of a map: name -> prior. Raises FileNotFound, FileFormat.");
  module.def(
      "load_prior", &load_prior, "json"_a,
      "A prior as JSON: {\"window\": {\"T_map_robot\": [x, y, theta], ...}} and so on, docs/formats.md.\n"
      "Raises FileNotFound, FileFormat.");
}

}  // namespace

void bind_files(nb::module_& module) {
  bind_map_files(module);
  bind_log_files(module);
  bind_pose_files(module);
}

}  // namespace landfall::python
