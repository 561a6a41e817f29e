#include <utility>

#include "bindings/c/handles.hpp"
#include "landfall/io.hpp"

namespace {

using landfall::c::array;
using landfall::c::from_c;
using landfall::c::guarded;
using landfall::c::required;
using landfall::c::to_c;

landfall::Occupancy occupancy(std::uint8_t value, std::size_t index) {
  if (value > LANDFALL_UNKNOWN)
    landfall::c::refuse("cells[" + std::to_string(index) + "] is " + std::to_string(value) +
                        ", expected LANDFALL_FREE, LANDFALL_OCCUPIED or LANDFALL_UNKNOWN");
  return static_cast<landfall::Occupancy>(value);
}

// Cells are read only where their number makes sense; otherwise the map's own validation names the fault.
landfall::GridMap grid_map(const landfall_grid& grid) {
  landfall::GridMap map{.width_cells = grid.width_cells,
                        .height_cells = grid.height_cells,
                        .resolution_m = grid.resolution_m,
                        .T_map_grid = from_c(grid.T_map_grid),
                        .cells = {}};
  const std::int64_t count = std::int64_t{grid.width_cells} * grid.height_cells;
  if (grid.width_cells <= 0 || grid.height_cells <= 0 || count > landfall::max_map_cells) return map;
  const auto cells = array(grid.cells, static_cast<std::size_t>(count), "grid.cells");
  map.cells.reserve(cells.size());
  for (const std::uint8_t value : cells) map.cells.push_back(occupancy(value, map.cells.size()));
  return map;
}

}  // namespace

landfall_status landfall_map_load(const char* path, landfall_map** map) {
  return guarded(__func__, [&] {
    auto*& made = required(map, "map");
    made = new landfall_map{landfall::load_map(&required(path, "path"))};
  });
}

landfall_status landfall_map_from_grid(const landfall_grid* grid, landfall_map** map) {
  return guarded(__func__, [&] {
    auto*& made = required(map, "map");
    made = new landfall_map{landfall::PreparedMap(grid_map(required(grid, "grid")))};
  });
}

landfall_status landfall_map_from_walls(const landfall_wall* walls, size_t wall_count, double resolution_m,
                                        landfall_map** map) {
  return guarded(__func__, [&] {
    auto*& made = required(map, "map");
    landfall::WallMap plan;
    for (const landfall_wall& wall : array(walls, wall_count, "walls"))
      plan.walls.push_back({from_c(wall.a_map), from_c(wall.b_map)});
    const landfall::GridFromWallsOptions grid{.resolution_m = resolution_m};
    made = new landfall_map{landfall::PreparedMap(std::move(plan), grid)};
  });
}

landfall_status landfall_map_grid(const landfall_map* map, landfall_grid* grid) {
  return guarded(__func__, [&] {
    const landfall::GridMap& source = required(map, "map").map.grid();
    required(grid, "grid") = {.width_cells = source.width_cells,
                              .height_cells = source.height_cells,
                              .resolution_m = source.resolution_m,
                              .T_map_grid = to_c(source.T_map_grid),
                              .cells = reinterpret_cast<const std::uint8_t*>(source.cells.data())};
  });
}

landfall_status landfall_map_prepare(const landfall_map* map) {
  return guarded(__func__, [&] { required(map, "map").map.prepare(); });
}

landfall_status landfall_map_save(const landfall_map* map, const char* yaml_path) {
  return guarded(__func__, [&] {
    landfall::save_grid_map(required(map, "map").map.grid(), &required(yaml_path, "yaml_path"));
  });
}

void landfall_map_free(landfall_map* map) {
  delete map;
}
