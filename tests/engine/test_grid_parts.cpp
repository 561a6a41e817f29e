// What method `grid` is made of: cones, local grids and the global grid.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <numbers>
#include <set>

#include "drawn_map.hpp"
#include "engine/methods/grid/global_grid.hpp"
#include "engine/methods/grid/local_grid.hpp"
#include "random_world.hpp"

namespace landfall {
namespace {

using internal::Cone;
using internal::Contours;
using internal::LocalGrid;
using internal::LocalModel;
using testing::Dice;

using Cells = std::vector<CellIndex>;
constexpr double half_diagonal = 0.5 * std::numbers::sqrt2;

using CellSet = std::set<std::pair<int, int>>;  // (row, col)

CellSet set_of(const Cells& cells) {
  CellSet set;
  for (const CellIndex cell : cells) set.insert({cell.row, cell.col});
  return set;
}

Cells arc_of(const Cone& cone) {
  Cells cells;
  internal::arc_cells(cone, cells);
  return cells;
}

Cells sector_of(const Cone& cone) {
  Cells cells;
  internal::sector_cells(cone, cells);
  return cells;
}

LocalGrid painted(const LocalModel& model, double heading_rad = 0.0) {
  LocalGrid grid;
  internal::LocalGridPainter(model).paint(heading_rad, grid);
  return grid;
}

std::map<std::pair<int, int>, int> weights_of(const LocalGrid& grid) {
  std::map<std::pair<int, int>, int> weights;
  for (std::size_t i = 0; i < grid.cells.size(); ++i)
    weights[{grid.cells[i].row, grid.cells[i].col}] = grid.weights[i];
  EXPECT_EQ(weights.size(), grid.cells.size()) << "a cell appears twice";
  return weights;
}

// Sums of the weights above and below 0.
std::pair<int, int> sums_of(const LocalGrid& grid) {
  std::pair<int, int> sums{0, 0};
  for (const int weight : grid.weights) (weight > 0 ? sums.first : sums.second) += weight;
  return sums;
}

Cone random_cone(Dice& dice, double widest_rad = 3.0) {
  return {.mount_x_cells = dice.between(-5.0, 5.0),
          .mount_y_cells = dice.between(-5.0, 5.0),
          .axis_rad = dice.between(-3.2, 3.2),
          .half_angle_rad = dice.chance(0.2) ? 0.0 : dice.between(0.0, widest_rad),
          .range_cells = dice.chance(0.2) ? dice.between(0.0, 2.0) : dice.between(0.0, 60.0),
          .echo = true};
}

// Whether a point is in the cone by the definition: as far as its range, within its half-angle.
bool holds(const Cone& cone, double x_cells, double y_cells, double slack) {
  const double x = x_cells - cone.mount_x_cells;
  const double y = y_cells - cone.mount_y_cells;
  return std::hypot(x, y) <= cone.range_cells + slack &&
         angle_distance(std::atan2(y, x), cone.axis_rad) <= cone.half_angle_rad + slack;
}

TEST(GridCone, ABeamStraightAheadIsALine) {
  const Cone cone{.range_cells = 3.5, .echo = true};  // the face of cell 4
  EXPECT_EQ(arc_of(cone), (Cells{{.col = 4, .row = 0}}));
  EXPECT_EQ(set_of(sector_of(cone)), (CellSet{{0, 0}, {0, 1}, {0, 2}, {0, 3}}));
}

TEST(GridCone, HeadingsAreThoseOfRep103) {
  // A mount to the left that looks left, turned by a quarter to the left: behind, looking back.
  const Cone cone{.mount_y_cells = 2.0, .axis_rad = 0.5 * std::numbers::pi, .range_cells = 3.5, .echo = true};
  EXPECT_EQ(arc_of(cone), (Cells{{.col = 0, .row = 6}}));
  EXPECT_EQ(arc_of(internal::turned(cone, 0.5 * std::numbers::pi)), (Cells{{.col = -6, .row = 0}}));
}

TEST(GridCone, WithoutEchoThereIsNoArc) {
  const Cone cone{.half_angle_rad = 0.1, .range_cells = 20.0, .echo = false};
  EXPECT_TRUE(arc_of(cone).empty());
  EXPECT_TRUE(set_of(sector_of(cone)).count({0, 20}));
}

TEST(GridCone, ArcsAreEightConnectedAndOneCellThick) {
  Dice dice(1);
  for (int i = 0; i < 2000; ++i) {
    const Cone cone = random_cone(dice);
    SCOPED_TRACE(i);
    const Cells arc = arc_of(cone);
    ASSERT_FALSE(arc.empty());
    const auto apart = [&](std::size_t a, std::size_t b) {
      return std::max(std::abs(arc[a].col - arc[b].col), std::abs(arc[a].row - arc[b].row));
    };
    for (std::size_t k = 1; k < arc.size(); ++k) EXPECT_EQ(apart(k, k - 1), 1);
    for (std::size_t k = 2; k < arc.size(); ++k) EXPECT_GE(apart(k, k - 2), 2);
    for (const CellIndex cell : arc) {
      const double distance = std::hypot(cell.col - cone.mount_x_cells, cell.row - cone.mount_y_cells);
      EXPECT_NEAR(distance, cone.range_cells + half_diagonal, half_diagonal + 1e-9);
    }
  }
}

TEST(GridCone, SectorsHoldTheCellsWhoseCentreIsInTheCone) {
  Dice dice(2);
  for (int i = 0; i < 500; ++i) {
    const Cone cone = random_cone(dice);
    SCOPED_TRACE(i);
    const CellSet sector = set_of(sector_of(cone));
    const double x = std::cos(cone.axis_rad);
    const double y = std::sin(cone.axis_rad);
    for (int row = -70; row <= 70; ++row) {
      for (int col = -70; col <= 70; ++col) {
        const bool in = sector.count({row, col}) > 0;
        if (cone.half_angle_rad > 0.0 && holds(cone, col, row, -1e-9)) {
          EXPECT_TRUE(in) << col << ", " << row;
        }
        // Beside the cone there are the cells that its axis passes through, before the face.
        const double along = x * (col - cone.mount_x_cells) + y * (row - cone.mount_y_cells);
        const double beside = y * (col - cone.mount_x_cells) - x * (row - cone.mount_y_cells);
        const bool on_axis = along >= -0.8 && along <= cone.range_cells + 0.3 && std::abs(beside) <= 0.8;
        if (in) {
          EXPECT_TRUE(on_axis || holds(cone, col, row, 1e-9)) << col << ", " << row;
        }
      }
    }
  }
}

TEST(GridLocal, AConeSumsUpToOneOfEitherSign) {
  Dice dice(3);
  int with_sector = 0;
  for (int i = 0; i < 500; ++i) {
    Cone cone = random_cone(dice);
    cone.echo = dice.chance(0.8);
    const LocalModel model{.cones = {cone}, .robot_radius_cells = 0.0};
    const int one = model.arc_weight();
    // The robot's own cell is the cone's weight below 0; put where no cone reaches.
    LocalModel far = model;
    far.cones[0].mount_x_cells += 100.0;
    const LocalGrid grid = painted(far);
    const auto [above, below] = sums_of(grid);
    EXPECT_EQ(above, cone.echo ? one : 0);
    const bool has_sector = below != -one;
    with_sector += has_sector ? 1 : 0;
    EXPECT_EQ(below, has_sector ? -2 * one : -one);
    if (cone.range_cells > 2.0) {
      EXPECT_TRUE(has_sector);
    }
    EXPECT_EQ(grid.perfect_score, above - below);
  }
  EXPECT_GT(with_sector, 300);
}

TEST(GridLocal, EachCellOfAnArcHasTheSameShare) {
  const LocalModel model{
      .cones = {{.mount_x_cells = 10.0, .half_angle_rad = 0.2, .range_cells = 20.0, .echo = true}},
      .robot_radius_cells = 0.0};
  const std::size_t cells = arc_of(model.cones[0]).size();
  EXPECT_EQ(cells, 9u);  // 2 x 20.5 sin 0.2 = 8.1: rows -4 to 4
  for (const auto& [at, weight] : weights_of(painted(model)))
    if (weight > 0) {
      EXPECT_NEAR(weight, model.arc_weight() / 9.0, 1.0);
    }
}

TEST(GridLocal, TheRobotIsFreeAsOftenAsItHasBeams) {
  LocalModel model{.cones = {}, .robot_radius_cells = 2.0};
  for (const double axis_rad : {0.0, 2.0, 4.0})
    model.cones.push_back({.mount_x_cells = 50.0 * std::cos(axis_rad),
                           .mount_y_cells = 50.0 * std::sin(axis_rad),
                           .axis_rad = axis_rad,
                           .range_cells = 5.0,
                           .echo = true});
  int sum = 0, cells = 0;
  for (const auto& [at, weight] : weights_of(painted(model))) {
    if (std::hypot(at.first, at.second) > 2.0) continue;
    sum += weight;
    ++cells;
  }
  EXPECT_EQ(cells, 13);  // of a disc of radius 2
  EXPECT_EQ(sum, -3 * model.arc_weight());
}

TEST(GridLocal, WhatABeamSawThroughLeavesTheOthersArc) {
  // An arc of rows -4 to 4 about x = 20.5, and a ray far through its row 0.
  const Cone wide{.mount_x_cells = 0.0, .half_angle_rad = 0.2, .range_cells = 20.0, .echo = true};
  const Cone ray{.range_cells = 40.0, .echo = true};
  const LocalModel model{.cones = {wide, ray}, .robot_radius_cells = 0.0};
  const auto weights = weights_of(painted(model));
  const Cells arc = arc_of(wide);
  int sum = 0;
  for (const CellIndex cell : arc) {
    const int weight = weights.at({cell.row, cell.col});
    if (cell.row == 0) {
      EXPECT_LT(weight, 0);
    } else {
      EXPECT_NEAR(weight, model.arc_weight() / 8.0, 1.0);
      sum += weight;
    }
  }
  EXPECT_EQ(sum, model.arc_weight());
}

TEST(GridLocal, AnArcThatIsSeenThroughAltogetherStays) {
  const Cone near{.range_cells = 10.5, .echo = true};
  const Cone far{.range_cells = 30.0, .echo = true};
  const LocalModel model{.cones = {near, far}, .robot_radius_cells = 0.0};
  EXPECT_EQ(weights_of(painted(model)).at({0, 11}), model.arc_weight());
  // So does one just before the other's end.
  const LocalModel beside{.cones = {{.half_angle_rad = 0.1, .range_cells = 20.0, .echo = true},
                                    {.range_cells = 21.5, .echo = true}},
                          .robot_radius_cells = 0.0};
  for (const CellIndex cell : arc_of(beside.cones[0]))
    EXPECT_GT(weights_of(painted(beside)).at({cell.row, cell.col}), 0);
}

TEST(GridLocal, SumsHoldForAnyOverlap) {
  Dice dice(4);
  for (int i = 0; i < 100; ++i) {
    LocalModel model{.cones = {}, .robot_radius_cells = dice.between(0.0, 4.0)};
    for (int k = dice.between(1, 30); k > 0; --k) {
      model.cones.push_back(random_cone(dice, 0.5));
      model.cones.back().echo = dice.chance(0.7);
    }
    const auto echoes =
        std::count_if(model.cones.begin(), model.cones.end(), [](const Cone& c) { return c.echo; });
    const LocalGrid grid = painted(model, dice.between(-3.0, 3.0));
    std::int64_t sum = 0;
    for (const int weight : grid.weights) sum += weight;
    const std::int64_t one = model.arc_weight();
    const auto cones = static_cast<std::int64_t>(model.cones.size());
    // Arcs, sectors and the robot; a short cone may have no sector.
    EXPECT_EQ(sum % one, 0);
    EXPECT_GE(sum, one * (echoes - 2 * cones));
    EXPECT_LE(sum, one * (echoes - cones));
    EXPECT_LE(grid.perfect_score, one * (echoes + 2 * cones));
  }
}

TEST(GridLocal, ManyBeamsStayWithinThirtyBits) {
  const LocalModel model{.cones = std::vector<Cone>(100'000), .robot_radius_cells = 0.0};
  EXPECT_LE(3.0 * 100'000.0 * model.arc_weight(), std::pow(2.0, 30));
}

TEST(GridLocal, OrientedGridsAgreeWithTheModelAtEveryHeading) {
  Dice dice(5);
  LocalModel model{.cones = {}, .robot_radius_cells = 3.0};
  for (int k = 0; k < 14; ++k)
    model.cones.push_back({.mount_x_cells = 3.0 * std::cos(0.45 * k),
                           .mount_y_cells = 3.0 * std::sin(0.45 * k),
                           .axis_rad = 0.45 * k,
                           .half_angle_rad = 0.105,
                           .range_cells = dice.between(8.0, 40.0),
                           .echo = true});
  for (int heading = 0; heading < 72; ++heading) {
    const double heading_rad = heading * std::numbers::pi / 36.0;
    SCOPED_TRACE(heading);
    const LocalGrid grid = painted(model, heading_rad);
    for (std::size_t i = 0; i < grid.cells.size(); ++i) {
      const CellIndex cell = grid.cells[i];
      // Seen from the robot as it stood: an arc's cell is at its cone's range, a free one within its cone.
      const double x = std::cos(heading_rad) * cell.col + std::sin(heading_rad) * cell.row;
      const double y = -std::sin(heading_rad) * cell.col + std::cos(heading_rad) * cell.row;
      const bool fits = std::any_of(model.cones.begin(), model.cones.end(), [&](const Cone& cone) {
        const double distance = std::hypot(x - cone.mount_x_cells, y - cone.mount_y_cells);
        const double angle =
            angle_distance(std::atan2(y - cone.mount_y_cells, x - cone.mount_x_cells), cone.axis_rad);
        const bool in_cone = angle <= cone.half_angle_rad + 0.75 / std::max(1.0, distance);
        if (grid.weights[i] > 0)
          return in_cone && std::abs(distance - cone.range_cells - half_diagonal) <= 0.75;
        return std::hypot(x, y) <= 3.0 + 1e-9 || distance < 1.0 ||
               (in_cone && distance <= cone.range_cells + 0.3);
      });
      EXPECT_TRUE(fits) << cell.col << ", " << cell.row;
    }
  }
}

TEST(GridLocal, ATurnedRasterLosesCells) {
  const LocalModel model{.cones = {{.half_angle_rad = 0.3, .range_cells = 30.0, .echo = true}},
                         .robot_radius_cells = 0.0};
  const LocalGrid straight = painted(model);
  EXPECT_EQ(weights_of(internal::turned_raster(straight, 0.0)), weights_of(straight));
  EXPECT_EQ(internal::turned_raster(straight, 0.5 * std::numbers::pi).cells.size(), straight.cells.size());
  EXPECT_LT(internal::turned_raster(straight, 0.6).cells.size(), straight.cells.size());
}

std::vector<std::string> contours_of(const std::vector<std::string>& lines, Contours contours) {
  const GridMap map = testing::drawn_map(lines);
  const std::vector<std::int8_t> cells = internal::global_grid(map, contours);
  std::vector<std::string> drawing;
  for (int row = map.height_cells - 1; row >= 0; --row) {
    std::string line;
    for (int col = 0; col < map.width_cells; ++col) {
      const std::int8_t value = cells[map.index({col, row})];
      line += value > 0 ? '#' : value < 0 ? '.' : '?';
    }
    drawing.push_back(line);
  }
  return drawing;
}

TEST(GridGlobal, OnlyContoursStayOccupied) {
  const std::vector<std::string> map{
      "..........",  //
      ".#####.##.",  //
      ".#####.##.",  //
      ".#####....",  //
      ".#####.?#.",  //
      "......####",  //
      ".#....####",  //
  };
  EXPECT_EQ(contours_of(map, Contours::corrected), (std::vector<std::string>{
                                                       "..........",  //
                                                       ".#####.##.",  //
                                                       ".#???#.##.",  //
                                                       ".#???#....",  //
                                                       ".#####.?#.",  //
                                                       "......##?#",  //
                                                       ".#....####",  //
                                                   }));
  EXPECT_EQ(contours_of(map, Contours::uncorrected), map);
}

TEST(GridGlobal, AContourIsOneCellThickAroundASlope) {
  EXPECT_EQ(contours_of({"#.....", "##....", "###...", "####..", "#####.", "######"}, Contours::corrected),
            (std::vector<std::string>{"#.....", "##....", "#?#...", "#??#..", "#???#.", "######"}));
}

}  // namespace
}  // namespace landfall
