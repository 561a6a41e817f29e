// Maps from sonars: triangulation-based fusion, inverse sensor models, end points.
#include <nanobind/stl/vector.h>

#include <vector>

#include "arrays.hpp"
#include "bindings.hpp"
#include "landfall/sonar_mapping.hpp"

namespace landfall::python {
namespace nb = nanobind;
using namespace nb::literals;

namespace {

Matrix<const float> values_of(nb::handle self) {
  const TbfResult& result = nb::cast<const TbfResult&>(self);
  return view(result.values.data(), static_cast<std::size_t>(result.map.height_cells),
              static_cast<std::size_t>(result.map.width_cells), self);
}

Matrix<double> points_of(const TbfResult& result) {
  std::vector<double> rows;
  for (const TriangulationPoint& point : result.points)
    rows.insert(rows.end(), {point.p_map.x_m, point.p_map.y_m});
  return adopt(std::move(rows), result.points.size(), 2);
}

Matrix<double> covariances_of(const TbfResult& result) {
  std::vector<double> rows;
  for (const TriangulationPoint& point : result.points)
    rows.insert(rows.end(), {point.covariance_xx_m2, point.covariance_xy_m2, point.covariance_yy_m2});
  return adopt(std::move(rows), result.points.size(), 3);
}

Matrix<std::int32_t> supports_of(const TbfResult& result) {
  std::vector<std::int32_t> rows;
  for (const TriangulationPoint& point : result.points)
    rows.insert(rows.end(), {point.triangulations, static_cast<std::int32_t>(point.scan),
                             static_cast<std::int32_t>(point.beam)});
  return adopt(std::move(rows), result.points.size(), 3);
}

void bind_result(nb::module_& module) {
  nb::class_<TbfResult>(module, "TbfResult",
                        "What triangulation-based fusion made of a drive: a map, and the points it is of.")
      .def_ro("map", &TbfResult::map)
      .def_prop_ro("values", &values_of, "g of equation 5: a read-only (height, width) float32 view, 0 to 1.")
      .def_prop_ro("points", &points_of, nb::rv_policy::move,
                   "(points, 2): x, y of each triangulation point in the map, metres.")
      .def_prop_ro("covariances", &covariances_of, nb::rv_policy::move,
                   "(points, 3): xx, xy, yy of each point, square metres.")
      .def_prop_ro("supports", &supports_of, nb::rv_policy::move,
                   "(points, 3) int32: the number of triangulations n_t, and the scan and beam of the last\n"
                   "reading that supports the point.")
      .def_ro("scans", &TbfResult::scans, "With the readings as they were fused: corrected to the box.");
}

void bind_tbf(nb::module_& module) {
  const TbfOptions defaults;
  module.def(
      "map_by_triangulation",
      [](const std::vector<Scan>& scans, double resolution_m, double margin_m, int window_scans,
         double max_deviation_m, double scale_m2, double occupied_value, bool bounding_box,
         bool box_corrects_no_echo, bool connect_walls, double wall_gap_m, double wall_length_m) {
        const nb::gil_scoped_release released;
        return map_by_triangulation(scans, {.resolution_m = resolution_m,
                                            .margin_m = margin_m,
                                            .window_scans = window_scans,
                                            .max_deviation_m = max_deviation_m,
                                            .scale_m2 = scale_m2,
                                            .occupied_value = occupied_value,
                                            .bounding_box = bounding_box,
                                            .box_corrects_no_echo = box_corrects_no_echo,
                                            .connect_walls = connect_walls,
                                            .wall_gap_m = wall_gap_m,
                                            .wall_length_m = wall_length_m});
      },
      "scans"_a, nb::kw_only(), "resolution_m"_a = defaults.resolution_m, "margin_m"_a = defaults.margin_m,
      "window_scans"_a = defaults.window_scans, "max_deviation_m"_a = defaults.max_deviation_m,
      "scale_m2"_a = defaults.scale_m2, "occupied_value"_a = defaults.occupied_value,
      "bounding_box"_a = defaults.bounding_box, "box_corrects_no_echo"_a = defaults.box_corrects_no_echo,
      "connect_walls"_a = defaults.connect_walls, "wall_gap_m"_a = defaults.wall_gap_m,
      "wall_length_m"_a = defaults.wall_length_m,
      "Triangulation-based fusion (Ivanjko, Petrovic & Miklic 2005) of sonar scans whose T_map_robot is set, "
      "in\n"
      "order. bounding_box: readings are corrected first (section 3). connect_walls: segments that line up "
      "are\n"
      "connected, and cells that belong to none dropped (section 6). scale_m2: A of equation 5. Raises\n"
      "InvalidArgument, TooLarge.");
  module.def(
      "correct_to_bounding_box", &correct_to_bounding_box, "scan"_a, "correct_no_echo"_a = true,
      nb::call_guard<nb::gil_scoped_release>(),
      "Readings that end outside of the box spanned by the sonars that face front, back, left and right,\n"
      "shortened along their own beam to its rim; the others as they are. Raises InvalidArgument.");
}

}  // namespace

void bind_sonar_mapping(nb::module_& module) {
  bind_result(module);
  bind_tbf(module);
  const SonarGridOptions defaults;
  module.def(
      "map_from_sonars",
      [](const std::vector<Scan>& scans, double resolution_m, double margin_m, double occupied_weight,
         double empty_weight) {
        const nb::gil_scoped_release released;
        return map_from_sonars(scans, {.resolution_m = resolution_m,
                                       .margin_m = margin_m,
                                       .occupied_weight = occupied_weight,
                                       .empty_weight = empty_weight});
      },
      "scans"_a, nb::kw_only(), "resolution_m"_a = defaults.resolution_m, "margin_m"_a = defaults.margin_m,
      "occupied_weight"_a = defaults.occupied_weight, "empty_weight"_a = defaults.empty_weight,
      "The occupancy grid of Elfes 1988 from sonar scans whose T_map_robot is set. Raises InvalidArgument,\n"
      "TooLarge.");
  module.def(
      "map_of_end_points",
      [](const std::vector<Scan>& scans, double resolution_m, double margin_m) {
        const nb::gil_scoped_release released;
        return map_of_end_points(scans, resolution_m, margin_m);
      },
      "scans"_a, nb::kw_only(), "resolution_m"_a = defaults.resolution_m, "margin_m"_a = defaults.margin_m,
      "Occupied where an echo ends along its beam's axis: readings as they are. Raises InvalidArgument, "
      "TooLarge.");
}

}  // namespace landfall::python
