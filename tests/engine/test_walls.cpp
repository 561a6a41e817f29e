#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "drawing.hpp"
#include "drawn_map.hpp"
#include "landfall/error.hpp"
#include "landfall/wall_map.hpp"

namespace landfall {
namespace {

using testing::drawing_of;

using ::testing::UnorderedElementsAre;

constexpr double pi = std::numbers::pi;

WallMap rectangle(double x_m, double y_m, double width_m, double height_m) {
  const Point2 a{.x_m = x_m, .y_m = y_m};
  const Point2 b{.x_m = x_m + width_m, .y_m = y_m};
  const Point2 c{.x_m = x_m + width_m, .y_m = y_m + height_m};
  const Point2 d{.x_m = x_m, .y_m = y_m + height_m};
  return {.walls = {{a, b}, {b, c}, {c, d}, {d, a}}};
}

double total_length_m(const WallMap& map) {
  double length_m = 0.0;
  for (const Wall& wall : map.walls)
    length_m += std::hypot(wall.b_map.x_m - wall.a_map.x_m, wall.b_map.y_m - wall.a_map.y_m);
  return length_m;
}

TEST(ToWalls, OneCellHasFourFaces) {
  const WallMap walls = to_walls(testing::drawn_map({"...", ".#.", "..."}, 0.5));
  EXPECT_THAT(walls.walls, UnorderedElementsAre(Wall{{0.5, 0.5}, {1.0, 0.5}},    // below
                                                Wall{{0.5, 1.0}, {1.0, 1.0}},    // above
                                                Wall{{0.5, 0.5}, {0.5, 1.0}},    // left
                                                Wall{{1.0, 0.5}, {1.0, 1.0}}));  // right
}

TEST(ToWalls, MergesCollinearFacesAndClosesTheBorder) {
  // A bar of 5 x 1 cells that fills its grid: four walls, though ten cells' faces are free-standing.
  const WallMap walls = to_walls(testing::drawn_map({"#####"}));
  EXPECT_EQ(walls.walls.size(), 4u);
  EXPECT_DOUBLE_EQ(total_length_m(walls), 12.0);
}

TEST(ToWalls, SeesNoFaceBetweenFreeAndUnknown) {
  EXPECT_TRUE(to_walls(testing::drawn_map({".?.", "?.?"})).walls.empty());
  EXPECT_EQ(to_walls(testing::drawn_map({"?#."})).walls.size(), 4u);
}

TEST(ToWalls, MergesAcrossCellsThatTouchAtACorner) {
  // The line between the rows, and that between the columns, are each one wall of two faces.
  const WallMap walls = to_walls(testing::drawn_map({".#", "#."}));
  EXPECT_EQ(walls.walls.size(), 6u);
  EXPECT_DOUBLE_EQ(total_length_m(walls), 8.0);
}

TEST(ToWalls, FollowsARotatedOrigin) {
  // A quarter turn about (10, 20): the cell's corner (1, 0) m of the grid is (10, 21) in the map.
  const WallMap walls =
      to_walls(testing::drawn_map({".#"}, 1.0, {.x_m = 10.0, .y_m = 20.0, .theta_rad = pi / 2}));
  double low_x_m = 99.0, high_x_m = -99.0, low_y_m = 99.0, high_y_m = -99.0;
  for (const Wall& wall : walls.walls)
    for (const Point2& end : {wall.a_map, wall.b_map}) {
      low_x_m = std::min(low_x_m, end.x_m);
      high_x_m = std::max(high_x_m, end.x_m);
      low_y_m = std::min(low_y_m, end.y_m);
      high_y_m = std::max(high_y_m, end.y_m);
    }
  EXPECT_NEAR(low_x_m, 9.0, 1e-12);
  EXPECT_NEAR(high_x_m, 10.0, 1e-12);
  EXPECT_NEAR(low_y_m, 21.0, 1e-12);
  EXPECT_NEAR(high_y_m, 22.0, 1e-12);
}

TEST(ToGrid, MarksEveryCellThatAWallTouches) {
  // From (0.5, 0.5) to (3.5, 2.0): rises half a cell per column.
  const WallMap slope{.walls = {{{0.5, 0.5}, {3.5, 1.9}}}};
  EXPECT_EQ(drawing_of(to_grid(slope, {.resolution_m = 1.0, .margin_m = 0.0})),
            (std::vector<std::string>{".###",  //
                                      "##.."}));
}

TEST(ToGrid, AWallThroughCornersStaysTight) {
  // The diagonal passes exactly through corners; its cells share edges, so that nothing slips through.
  const WallMap diagonal{.walls = {{{0.5, 0.5}, {2.5, 2.5}}}};
  EXPECT_EQ(drawing_of(to_grid(diagonal, {.resolution_m = 1.0, .margin_m = 0.0})),
            (std::vector<std::string>{"..#",  //
                                      ".##",  //
                                      "##."}));
}

TEST(ToGrid, WidensTheBoundingBoxByItsMargin) {
  const GridMap grid = to_grid(rectangle(1.25, 2.25, 1.0, 0.5), {.resolution_m = 0.5, .margin_m = 1.0});
  EXPECT_EQ(drawing_of(grid), (std::vector<std::string>{".......",  //
                                                        ".......",  //
                                                        "..###..",  //
                                                        "..###..",  //
                                                        ".......",  //
                                                        "......."}));
  EXPECT_EQ(grid.T_map_grid, (Pose2{.x_m = 0.0, .y_m = 1.0, .theta_rad = 0.0}));
}

TEST(ToGrid, FloodsTheOutside) {
  WallMap walls = rectangle(0.5, 0.5, 4.0, 3.0);
  const GridFromWallsOptions options{.resolution_m = 1.0, .margin_m = 1.0, .outside_unknown = true};
  EXPECT_EQ(drawing_of(to_grid(walls, options)), (std::vector<std::string>{"???????",  //
                                                                           "?#####?",  //
                                                                           "?#...#?",  //
                                                                           "?#...#?",  //
                                                                           "?#####?",  //
                                                                           "???????"}));
  walls.walls.erase(walls.walls.begin());  // without its lower wall the room is outside, too
  EXPECT_EQ(drawing_of(to_grid(walls, options)), (std::vector<std::string>{"???????",  //
                                                                           "?#####?",  //
                                                                           "?#???#?",  //
                                                                           "?#???#?",  //
                                                                           "?#???#?",  //
                                                                           "???????"}));
}

TEST(ToGrid, BringsBackTheCellsWhoseOutlineItIsGiven) {
  // Faces pulled half a cell into their own cells draw those cells: here a ring of centre lines.
  const std::vector<std::string> ring{"#####",  //
                                      "#...#",  //
                                      "#####"};
  EXPECT_EQ(drawing_of(to_grid(rectangle(0.5, 0.5, 4.0, 2.0), {.resolution_m = 1.0, .margin_m = 0.0})), ring);
}

ErrorCode error_of(const WallMap& map, const GridFromWallsOptions& options) {
  try {
    to_grid(map, options);
  } catch (const Error& error) {
    return error.code();
  }
  return ErrorCode::file_write;  // none of those expected
}

TEST(ToGrid, RefusesWhatItCannotDraw) {
  const WallMap good = rectangle(0.0, 0.0, 1.0, 1.0);
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(error_of({}, {}), ErrorCode::invalid_argument);
  EXPECT_EQ(error_of({.walls = {{{0.0, nan}, {1.0, 1.0}}}}, {}), ErrorCode::invalid_argument);
  EXPECT_EQ(error_of(good, {.resolution_m = 0.0}), ErrorCode::invalid_argument);
  EXPECT_EQ(error_of(good, {.resolution_m = nan}), ErrorCode::invalid_argument);
  EXPECT_EQ(error_of(good, {.margin_m = -1.0}), ErrorCode::invalid_argument);
  EXPECT_EQ(error_of(rectangle(0.0, 0.0, 1e5, 1e5), {}), ErrorCode::too_large);
  EXPECT_EQ(error_of(rectangle(0.0, 0.0, 1e300, 1.0), {}), ErrorCode::too_large);
}

TEST(WallMap, ErrorsNameTheWall) {
  try {
    validate(
        {.walls = {{{0.0, 0.0}, {1.0, 1.0}}, {{0.0, 0.0}, {std::numeric_limits<double>::infinity(), 1.0}}}});
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("wall 1 has the coordinate inf"), std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace landfall
