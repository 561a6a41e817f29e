#include "bench/growth_cases.hpp"

#include <algorithm>
#include <cstdio>
#include <memory>
#include <numbers>

#include "bench/floor.hpp"
#include "bench/office.hpp"
#include "bench/places.hpp"
#include "landfall/io.hpp"
#include "landfall/simulate.hpp"
#include "tests/data_folder.hpp"

namespace landfall::bench {
namespace {

constexpr int usual_beams = 180;

std::string cells_name(const std::string& kind, int width_cells, int height_cells) {
  return kind + "/cells:" + std::to_string(width_cells) + "x" + std::to_string(height_cells);
}

// Half a turn in so many beams, from random free poses.
std::vector<Question> look_around(const PreparedMap& map, int beams) {
  const auto sensor = std::make_shared<const Sensor>(
      make_fan({.beams = beams, .first_rad = -std::numbers::pi / 2.0, .step_rad = std::numbers::pi / beams}));
  std::vector<Question> questions;
  for (const Scan& scan : simulate(map, sensor, random_free_poses(map.grid(), scans_per_case)))
    questions.push_back({map, scan});
  return questions;
}

Case made_up(const std::string& kind, const std::function<GridMap()>& draw) {
  const GridMap drawn = draw();
  return {cells_name(kind, drawn.width_cells, drawn.height_cells),
          [draw] { return look_around(PreparedMap(draw()), usual_beams); }};
}

struct Building {
  GridMap map;
  std::vector<Scan> log;
  std::vector<StampedPose> truth;

  // Evenly spread over the log.
  [[nodiscard]] std::size_t query(std::size_t i) const { return i * (log.size() - 1) / (scans_per_case - 1); }
};

GridMap load_building_map(const std::string& name) {
  return load_grid_map(testing::data_folder() / name / "map.yaml");
}

Building load_building(const std::string& name) {
  return {load_building_map(name), load_log(testing::data_folder() / name / "query.log.gz").scans,
          load_trajectory(testing::data_folder() / name / "truth.tum")};
}

// So many cells around the point, moved to where the map has them all; the map where it has not so many.
GridMap cut_out(const GridMap& map, const Point2& p_map, int side_cells) {
  const CellIndex middle = map.cell_of(p_map);
  const int width = std::min(side_cells, map.width_cells);
  const int height = std::min(side_cells, map.height_cells);
  const int left = std::clamp(middle.col - width / 2, 0, map.width_cells - width);
  const int bottom = std::clamp(middle.row - height / 2, 0, map.height_cells - height);
  GridMap part{
      .width_cells = width,
      .height_cells = height,
      .resolution_m = map.resolution_m,
      .T_map_grid = map.T_map_grid *
                    Pose2{.x_m = left * map.resolution_m, .y_m = bottom * map.resolution_m, .theta_rad = 0.0},
      .cells = {}};
  for (int row = bottom; row < bottom + height; ++row) {
    const auto first = map.cells.begin() + static_cast<std::ptrdiff_t>(map.index({left, row}));
    part.cells.insert(part.cells.end(), first, first + width);
  }
  return part;
}

std::vector<Question> ask_in_cuts(const Building& building, int side_cells) {
  std::vector<Question> questions;
  for (std::size_t i = 0; i < scans_per_case; ++i) {
    const Pose2& T_map_robot = building.truth[building.query(i)].pose;
    questions.push_back({PreparedMap(cut_out(building.map, {T_map_robot.x_m, T_map_robot.y_m}, side_cells)),
                         building.log[building.query(i)]});
  }
  return questions;
}

std::vector<Question> ask_in_whole(const Building& building) {
  const PreparedMap map(building.map);
  std::vector<Question> questions;
  for (std::size_t i = 0; i < scans_per_case; ++i)
    questions.push_back({map, building.log[building.query(i)]});
  return questions;
}

std::vector<Case> cuts(const std::string& name) {
  const GridMap whole = load_building_map(name);
  std::vector<Case> cases;
  for (const int side_cells : {38, 76, 152, 304, 608, 1216, 2432})
    cases.push_back(
        {cells_name("cut", std::min(side_cells, whole.width_cells), std::min(side_cells, whole.height_cells)),
         [name, side_cells] { return ask_in_cuts(load_building(name), side_cells); }});
  cases.push_back({cells_name("cut", whole.width_cells, whole.height_cells),
                   [name] { return ask_in_whole(load_building(name)); }});
  return cases;
}

}  // namespace

// Larger ones of either take minutes: their rooms look much alike, so that rivals grow as the map does.
std::vector<Case> made_up_maps() {
  std::vector<Case> cases;
  for (const int side_cells : {38, 61, 121, 241, 481, 961, 1921})
    cases.push_back(made_up("floor", [side_cells] { return Floor::draw(side_cells); }));
  for (const int rooms : {1, 2, 4, 8, 16, 32})
    cases.push_back(made_up("office", [rooms] { return office(rooms); }));
  return cases;
}

std::vector<Case> beam_counts() {
  std::vector<Case> cases;
  for (const int beams : {45, 90, 180, 360, 720, 1440})
    cases.push_back({"beams/" + std::to_string(beams),
                     [beams] { return look_around(PreparedMap(Floor::draw(961)), beams); }});
  return cases;
}

std::vector<Case> buildings() {
  if (!testing::has_data()) {
    std::fprintf(stderr, "no real data: set LANDFALL_DATA\n");
    return {};
  }
  std::vector<Case> cases = cuts("infinite_corridor");
  for (const std::string name : {"intel", "csail", "aces", "acapulco", "infinite_corridor"})
    cases.push_back({"building/" + name, [name] { return ask_in_whole(load_building(name)); }});
  return cases;
}

}  // namespace landfall::bench
