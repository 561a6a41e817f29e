// The published maps and plans: sizes and counts of cells as an independent reading of the files gives.
#include <algorithm>

#include "io_test.hpp"
#include "landfall/io.hpp"
#include "tests/data_folder.hpp"

namespace landfall::testing {
namespace {

struct RealMap {
  const char* name;
  int width_cells;
  int height_cells;
  std::ptrdiff_t occupied;
  std::ptrdiff_t free;
};

const std::vector<RealMap> maps = {
    {"maps/PRBonn_tmcl_FMap", 521, 279, 6205, 110573},
    {"maps/PRBonn_tmcl_GMap", 604, 272, 9239, 104364},
    {"maps/PRBonn_tmcl_YouBotMap", 576, 960, 10354, 105472},
    {"maps/comprobo20_ac109_4", 1056, 992, 777, 33170},
    {"maps/declutter_aaf_deployment16-cropped", 1372, 2885, 38292, 588679},
    {"maps/declutter_tsc", 1419, 1765, 38534, 726681},
    {"maps/declutter_tsc20160523", 1730, 1811, 35924, 638018},
    {"maps/declutter_y4_aaf-cropped", 1101, 2853, 47832, 652623},
    {"maps/fetchrobotics_4_26_15", 1029, 1146, 32973, 389199},
    {"maps/mit-racecar_building_31", 693, 648, 17553, 431063},
    {"maps/mit-racecar_stata_basement", 1730, 1300, 18384, 310278},
    {"maps/turtlebot_willow-2010-02-18-0.10", 566, 608, 544, 109207},
    {"acapulco/map", 2200, 1320, 38547, 1699864},
    {"aces/map", 1200, 1140, 16776, 295959},
    {"csail/map", 980, 1360, 20581, 319381},
    {"infinite_corridor/map", 4800, 4120, 79457, 1436290},
    {"intel/map", 640, 640, 17152, 202823},
    {"wean_hall/map", 800, 800, 19159, 97222},
};

TEST(RealMaps, CellsAsCountedIndependently) {
  LANDFALL_REQUIRE_DATA();
  for (const RealMap& real : maps) {
    SCOPED_TRACE(real.name);
    const GridMap map = load_grid_map(data_folder() / (std::string(real.name) + ".yaml"));
    EXPECT_NO_THROW(validate(map));
    EXPECT_EQ(map.width_cells, real.width_cells);
    EXPECT_EQ(map.height_cells, real.height_cells);
    EXPECT_EQ(std::count(map.cells.begin(), map.cells.end(), Occupancy::occupied), real.occupied);
    EXPECT_EQ(std::count(map.cells.begin(), map.cells.end(), Occupancy::free), real.free);
  }
}

TEST(RealMaps, OriginsAndResolutions) {
  LANDFALL_REQUIRE_DATA();
  const GridMap intel = load_grid_map(data_folder() / "intel" / "map.yaml");
  EXPECT_EQ(intel.resolution_m, 0.05);
  EXPECT_EQ(intel.T_map_grid, (Pose2{.x_m = -12, .y_m = -25, .theta_rad = 0}));
  const GridMap basement = load_grid_map(data_folder() / "maps" / "mit-racecar_stata_basement.yaml");
  EXPECT_EQ(basement.resolution_m, 0.0504);
  EXPECT_EQ(basement.T_map_grid, (Pose2{.x_m = 25.9, .y_m = 48.5, .theta_rad = 3.14}));
}

// The mapping robots drove where their maps are free: a map that is upside down has them in the unknown.
TEST(RealMaps, TruePosesOfTheQueriesAreFree) {
  LANDFALL_REQUIRE_DATA();
  for (const char* building : {"intel", "csail", "aces", "acapulco", "infinite_corridor"}) {
    SCOPED_TRACE(building);
    const GridMap map = load_grid_map(data_folder() / building / "map.yaml");
    const auto truth = load_trajectory(data_folder() / building / "truth.tum");
    ASSERT_FALSE(truth.empty());
    const auto free = std::count_if(truth.begin(), truth.end(), [&](const StampedPose& stamped) {
      const Pose2& T_map_robot = stamped.pose;
      return map.at(map.cell_of({.x_m = T_map_robot.x_m, .y_m = T_map_robot.y_m})) == Occupancy::free;
    });
    EXPECT_GE(static_cast<double>(free), 0.99 * static_cast<double>(truth.size()));
  }
}

TEST(RealMaps, Plans) {
  LANDFALL_REQUIRE_DATA();
  const auto plans = data_folder() / "plans";
  EXPECT_EQ(load_wall_map(plans / "AMROffice.json").walls.size(), 243U);
  EXPECT_EQ(load_wall_map(plans / "mall_site1_B1.json").walls.size(), 3340U);
  EXPECT_EQ(load_wall_map(plans / "mall_site1_F1.json").walls.size(), 1008U);
  EXPECT_EQ(load_wall_map(plans / "mall_site1_F2.json").walls.size(), 911U);
  EXPECT_EQ(load_wall_map(plans / "mall_site1_F3.json").walls.size(), 919U);
  EXPECT_EQ(load_wall_map(plans / "mall_site1_F4.json").walls.size(), 843U);
  EXPECT_EQ(load_wall_map(plans / "AMROffice.json").walls[0],
            (Wall{.a_map = {.x_m = 3.68, .y_m = 25.836}, .b_map = {.x_m = 3.677, .y_m = 24.307}}));
}
}  // namespace
}  // namespace landfall::testing
