// GridMap, WallMap and PreparedMap; their cells, walls and fields as read-only NumPy views.
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>

#include <span>
#include <string>
#include <tuple>

#include "arguments.hpp"
#include "arrays.hpp"
#include "bindings.hpp"
#include "engine/base/number_text.hpp"
#include "landfall/error.hpp"
#include "landfall/grid_map.hpp"
#include "landfall/prepared_map.hpp"
#include "landfall/wall_map.hpp"

namespace landfall::python {
namespace nb = nanobind;
using namespace nb::literals;

namespace {

static_assert(sizeof(Occupancy) == 1 && sizeof(Wall) == 4 * sizeof(double));

template <class T>
GridMap make_grid(const ArrayLike<T>& cells, double resolution_m, const Pose2& T_map_grid) {
  const std::vector<std::size_t> shape = shape_of(cells);
  if (shape.size() != 2) {
    throw Error(ErrorCode::invalid_argument,
                "GridMap: cells of shape " + shape_text(shape) + ", expected (height, width)");
  }
  GridMap map{.width_cells = static_cast<int>(shape[1]),
              .height_cells = static_cast<int>(shape[0]),
              .resolution_m = resolution_m,
              .T_map_grid = T_map_grid,
              .cells = {}};
  map.cells.reserve(cells.array.size());
  for (std::size_t i = 0; i < cells.array.size(); ++i) {
    const T value = cells.array.data()[i];
    if (value != T{0} && value != T{1} && value != T{2}) {
      throw Error(ErrorCode::invalid_argument, "GridMap: cell (row " + std::to_string(i / shape[1]) +
                                                   ", column " + std::to_string(i % shape[1]) + ") is " +
                                                   number_text(static_cast<double>(value)) +
                                                   ", expected 0 (free), 1 (occupied) or 2 (unknown)");
    }
    map.cells.push_back(static_cast<Occupancy>(value));
  }
  validate(map);
  return map;
}

WallMap make_walls(const ArrayLike<double>& walls) {
  const std::span<const double> values = rows_of(walls, 4, "WallMap");
  WallMap map;
  map.walls.reserve(values.size() / 4);
  for (std::size_t i = 0; i < values.size(); i += 4) {
    map.walls.push_back({{values[i], values[i + 1]}, {values[i + 2], values[i + 3]}});
  }
  validate(map);
  return map;
}

Matrix<const std::uint8_t> cells_of(nb::handle self) {
  const GridMap& map = nb::cast<const GridMap&>(self);
  return view(reinterpret_cast<const std::uint8_t*>(map.cells.data()),
              static_cast<std::size_t>(map.height_cells), static_cast<std::size_t>(map.width_cells), self);
}

Matrix<const double> walls_of(nb::handle self) {
  const WallMap& map = nb::cast<const WallMap&>(self);
  return view(reinterpret_cast<const double*>(map.walls.data()), map.walls.size(), 4, self);
}

template <class T>
Matrix<const T> grid_array(nb::handle self, std::span<const T> values) {
  const GridMap& grid = nb::cast<const PreparedMap&>(self).grid();
  return view(values.data(), static_cast<std::size_t>(grid.height_cells),
              static_cast<std::size_t>(grid.width_cells), self);
}

Matrix<const std::uint8_t> field_of(nb::handle self) {
  const PreparedMap& map = nb::cast<const PreparedMap&>(self);
  std::span<const std::uint8_t> field;
  {
    const nb::gil_scoped_release released;
    field = map.field();
  }
  return grid_array(self, field);
}

Matrix<const std::int32_t> squared_distance_of(nb::handle self) {
  const PreparedMap& map = nb::cast<const PreparedMap&>(self);
  std::span<const std::int32_t> squared;
  {
    const nb::gil_scoped_release released;
    squared = map.squared_distance_cells();
  }
  return grid_array(self, squared);
}

void bind_grid_map(nb::module_& module) {
  nb::class_<GridMap>(
      module, "GridMap",
      "Occupancy grid. `cells` is a read-only (height, width) uint8 view without copy: 0 free, "
      "1 occupied, 2 unknown; row 0 is the bottom.")
      .def(
          "__init__",
          [](GridMap* self, const CellsArgument& cells, double resolution_m, const PoseArgument& T_map_grid) {
            new (self) GridMap(cells.are_bytes ? make_grid(cells.bytes, resolution_m, T_map_grid)
                                               : make_grid(cells.numbers, resolution_m, T_map_grid));
          },
          "cells"_a, "resolution_m"_a, "T_map_grid"_a = PoseArgument{},
          "cells: (height, width) of 0, 1 and 2, row 0 at the bottom; uint8 is read without conversion.\n"
          "T_map_grid: the lower-left corner of cell (0, 0) and the direction of the grid's axes.\n"
          "Raises InvalidArgument, TooLarge.")
      .def_ro("width_cells", &GridMap::width_cells)
      .def_ro("height_cells", &GridMap::height_cells)
      .def_ro("resolution_m", &GridMap::resolution_m)
      .def_ro("T_map_grid", &GridMap::T_map_grid)
      .def_prop_ro("cells", &cells_of)
      .def("to_walls", &to_walls, nb::call_guard<nb::gil_scoped_release>(),
           "The faces between occupied and other cells, collinear neighbours merged.")
      .def(
          "center_of",
          [](const GridMap& map, int row, int col) {
            const Point2 p = map.center_of({.col = col, .row = row});
            return std::make_tuple(p.x_m, p.y_m);
          },
          "row"_a, "col"_a, "The centre of a cell, in the map frame: (x_m, y_m).")
      .def(
          "cell_of",
          [](const GridMap& map, double x_m, double y_m) {
            const CellIndex cell = map.cell_of({x_m, y_m});
            return std::make_tuple(cell.row, cell.col);
          },
          "x_m"_a, "y_m"_a, "(row, column) of the cell that holds a point of the map frame.")
      .def("__repr__", [](const GridMap& map) {
        return "GridMap(" + std::to_string(map.width_cells) + " x " + std::to_string(map.height_cells) +
               " cells, resolution_m=" + number_text(map.resolution_m) + ")";
      });
}

void bind_wall_map(nb::module_& module) {
  nb::class_<WallMap>(
      module, "WallMap",
      "A floor plan of straight walls. `walls` is a read-only (n, 4) float64 view: x1, y1, x2, "
      "y2 in metres, map frame.")
      .def(
          "__init__",
          [](WallMap* self, const ArrayLike<double>& walls) { new (self) WallMap(make_walls(walls)); },
          "walls"_a, "walls: (n, 4): x1, y1, x2, y2, metres. Raises InvalidArgument.")
      .def_prop_ro("walls", &walls_of)
      .def(
          "to_grid",
          [](const WallMap& map, double resolution_m, double margin_m, bool outside_unknown) {
            const nb::gil_scoped_release released;
            return to_grid(
                map,
                {.resolution_m = resolution_m, .margin_m = margin_m, .outside_unknown = outside_unknown});
          },
          "resolution_m"_a = 0.05, "margin_m"_a = 0.5, "outside_unknown"_a = false,
          "The grid whose occupied cells are those that a wall touches. Raises InvalidArgument, TooLarge.")
      .def("__len__", [](const WallMap& map) { return map.walls.size(); })
      .def("__repr__",
           [](const WallMap& map) { return "WallMap(" + std::to_string(map.walls.size()) + " walls)"; });
}

void bind_prepared_map(nb::module_& module) {
  nb::class_<PreparedMap>(
      module, "PreparedMap",
      "A map with all that is derived from it, each part built on first need; immutable and "
      "shared by threads.")
      .def(
          "__init__",
          [](PreparedMap* self, const GridMap& map, double field_sigma_m, const std::string& name) {
            new (self) PreparedMap(map, PrepareOptions{.field_sigma_m = field_sigma_m, .name = name});
          },
          "map"_a, nb::kw_only(), "field_sigma_m"_a = PrepareOptions{}.field_sigma_m, "name"_a = "",
          "field_sigma_m: width of the likelihood field. name: shown where several maps are searched.")
      .def(
          "__init__",
          [](PreparedMap* self, const WallMap& map, double resolution_m, double margin_m,
             bool outside_unknown, double field_sigma_m, const std::string& name) {
            const GridFromWallsOptions grid{
                .resolution_m = resolution_m, .margin_m = margin_m, .outside_unknown = outside_unknown};
            new (self) PreparedMap(map, grid, PrepareOptions{.field_sigma_m = field_sigma_m, .name = name});
          },
          "map"_a, nb::kw_only(), "resolution_m"_a = 0.05, "margin_m"_a = 0.5, "outside_unknown"_a = false,
          "field_sigma_m"_a = PrepareOptions{}.field_sigma_m, "name"_a = "",
          "A plan is searched on its grid and verified against its own exact walls.")
      .def_prop_ro("grid", &PreparedMap::grid, nb::rv_policy::reference_internal)
      .def_prop_ro("walls", &PreparedMap::walls, nb::rv_policy::reference_internal,
                   "The walls that rays are cast against.")
      .def_prop_ro("name", [](const PreparedMap& map) { return map.options().name; })
      .def_prop_ro("field_sigma_m", [](const PreparedMap& map) { return map.options().field_sigma_m; })
      .def("field", &field_of,
           "The likelihood field: a read-only (height, width) uint8 view without copy, row 0 at the bottom.")
      .def("squared_distance_cells", &squared_distance_of,
           "Squared distance to the nearest occupied cell, in cells: a read-only (height, width) int32 view.")
      .def("prepare", &PreparedMap::prepare, nb::call_guard<nb::gil_scoped_release>(),
           "Builds all that the default search needs now rather than on first use.")
      .def_prop_ro("memory_bytes", &PreparedMap::memory_bytes)
      .def("__repr__", [](const PreparedMap& map) {
        return "PreparedMap(" + std::to_string(map.grid().width_cells) + " x " +
               std::to_string(map.grid().height_cells) + " cells, name='" + map.options().name + "')";
      });
}

}  // namespace

void bind_maps(nb::module_& module) {
  bind_grid_map(module);
  bind_wall_map(module);
  bind_prepared_map(module);
}

}  // namespace landfall::python
