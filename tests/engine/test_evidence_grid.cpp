#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "engine/base/counter_rng.hpp"
#include "engine/mapping/slam/evidence_grid.hpp"
#include "raycast/grid_walk.hpp"

namespace landfall {
namespace {

using internal::EchoRay;
using internal::EvidenceGrid;

// Cells of a metre, for counting by hand.
SlamOptions coarse() {
  SlamOptions options;
  options.resolution_m = 1.0;
  options.deletion_range_m = 20.0;
  return options;
}

EchoRay ray(double x0, double y0, double x1, double y1) {
  return {.from_map = {x0, y0}, .to_map = {x1, y1}, .noise_m = 0.0};
}

// '#', '.', '?'; the first line is the top row.
std::string drawn(const EvidenceGrid& grid, int cols, int rows) {
  std::string lines;
  for (int row = rows - 1; row >= 0; --row) {
    for (int col = 0; col < cols; ++col) {
      const Occupancy cell = grid.at({.col = col, .row = row});
      lines += cell == Occupancy::occupied ? '#' : cell == Occupancy::free ? '.' : '?';
    }
    lines += '\n';
  }
  return lines;
}

TEST(EvidenceGrid, FreesUpToTheEcho) {
  EvidenceGrid grid(coarse());
  EXPECT_TRUE(grid.empty());
  grid.add_scan(std::vector{ray(0.5, 0.5, 4.5, 0.5), ray(0.5, 0.5, 0.5, 2.5)});
  EXPECT_EQ(drawn(grid, 6, 3),
            "#?????\n"
            ".?????\n"
            "....#?\n");
}

// One scan, the robot at a corner of cells and rays along their borders among them.
TEST(EvidenceGrid, PassesTheCellsOfTheOracle) {
  internal::CounterRng rng(5);
  for (int round = 0; round < 400; ++round) {
    EvidenceGrid grid(coarse());
    const auto coordinate = [&] {
      return round % 2 == 0 ? 40.0 * rng.uniform() - 20.0 : rng.below(40) - 20.0;
    };
    const EchoRay one = ray(coordinate(), coordinate(), coordinate(), coordinate());
    if (one.from_map == one.to_map) continue;
    grid.add_scan(std::vector{one});
    const CellIndex end = grid.cell_of(one.to_map);
    raycast::CellWalk walk(one.from_map.x_m, one.from_map.y_m, one.to_map.x_m - one.from_map.x_m,
                           one.to_map.y_m - one.from_map.y_m);
    int passed = 0;
    int seen_free = 0;
    for (; walk.entered() < 1.0 - 1e-9; walk.step()) {
      const CellIndex cell{.col = walk.col(), .row = walk.row()};
      if (cell == end) break;
      ++passed;
      seen_free += grid.at(cell) == Occupancy::free ? 1 : 0;
    }
    EXPECT_EQ(grid.at(end), Occupancy::occupied) << round;
    // Through a corner of cells either neighbour may be taken.
    EXPECT_GE(seen_free, passed - (round % 2 == 0 ? 0 : passed / 2)) << round;
  }
}

TEST(EvidenceGrid, GrowsWithWhatItHolds) {
  EvidenceGrid grid(coarse());
  grid.add_scan(std::vector{ray(0.5, 0.5, 4.5, 0.5)});
  const std::size_t small = grid.memory_bytes();
  grid.add_scan(std::vector{ray(0.5, 0.5, -400.5, 0.5), ray(0.5, 0.5, 0.5, -300.5)});
  EXPECT_GT(grid.memory_bytes(), small);
  EXPECT_EQ(grid.at({.col = 4, .row = 0}), Occupancy::occupied);
  EXPECT_EQ(grid.at({.col = -401, .row = 0}), Occupancy::occupied);
  EXPECT_EQ(grid.at({.col = 0, .row = -301}), Occupancy::occupied);
  EXPECT_EQ(grid.at({.col = -200, .row = 0}), Occupancy::free);
  EXPECT_EQ(grid.at({.col = -402, .row = 0}), Occupancy::unknown);
  const GridMap map = grid.to_map();
  EXPECT_EQ(map.width_cells, 406);
  EXPECT_EQ(map.height_cells, 302);
  EXPECT_EQ(map.T_map_grid, (Pose2{-401.0, -301.0, 0.0}));
  // Every occupied cell has its bit, and no other has one.
  const kernels::CellBits bits = grid.occupied();
  int marked = 0;
  for (int row = 0; row < bits.height_cells; ++row)
    for (int col = 0; col < bits.width_cells; ++col)
      if (((bits.words[row * bits.row_words + col / 32] >> (col % 32)) & 1U) != 0) {
        ++marked;
        EXPECT_EQ(grid.at({.col = col + grid.first().col, .row = row + grid.first().row}),
                  Occupancy::occupied);
      }
  EXPECT_EQ(marked, 3);
}

// A person stands before a wall for a long time and goes.
TEST(EvidenceGrid, DeletesWhatItSeesThrough) {
  SlamOptions options = coarse();
  for (const double deletion_range_m : {20.0, 0.0}) {
    options.deletion_range_m = deletion_range_m;
    EvidenceGrid grid(options);
    for (int scan = 0; scan < 30; ++scan) grid.add_scan(std::vector{ray(0.5, 0.5, 3.5, 0.5)});
    EXPECT_EQ(drawn(grid, 8, 1), "...#????\n");
    std::vector<Point2> gone;
    int scans = 0;
    while (gone.empty()) {
      gone = grid.add_scan(std::vector{ray(0.5, 0.5, 6.5, 0.5)});
      ++scans;
    }
    EXPECT_EQ(gone, (std::vector<Point2>{{3.5, 0.5}}));
    // Three scans in a row where deletion reaches; else what evidence asks for: 3.5 - 8 x 0.4 < 0.4.
    EXPECT_EQ(scans, deletion_range_m > 0.0 ? 3 : 8);
    EXPECT_EQ(drawn(grid, 8, 1), deletion_range_m > 0.0 ? "......#?\n" : "...?..#?\n");
  }
}

TEST(EvidenceGrid, SparesWhatItIsToldTo) {
  EvidenceGrid grid(coarse());
  grid.add_scan(std::vector{ray(0.5, 0.5, 3.5, 0.5)});
  const auto spares = [](const Point2& p_map, const EchoRay&) { return p_map == Point2{3.5, 0.5}; };
  for (int scan = 0; scan < 9; ++scan)
    EXPECT_TRUE(grid.add_scan(std::vector{ray(0.5, 0.5, 6.5, 0.5)}, spares).empty());
  EXPECT_EQ(drawn(grid, 8, 1), "...#..#?\n");
}

TEST(EvidenceGrid, OneWrongEchoDeletesNothing) {
  EvidenceGrid grid(coarse());
  for (int scan = 0; scan < 30; ++scan) {
    grid.add_scan(std::vector{ray(0.5, 0.5, 3.5, 0.5)});
    if (scan % 3 == 2) grid.add_scan(std::vector{ray(0.5, 0.5, 6.5, 0.5)});
  }
  EXPECT_EQ(grid.at({.col = 3, .row = 0}), Occupancy::occupied);
}

// A door opens: the echoes move from the doorway to the wall behind it.
TEST(EvidenceGrid, OpenedDoorIsNoObstacleAndAClosedOneIs) {
  EvidenceGrid grid(coarse());
  const auto look = [&](double x) {
    std::vector<EchoRay> rays;
    rays.reserve(3);
    for (int row = 0; row < 3; ++row) rays.push_back(ray(0.5, 1.5, row == 1 ? x : 4.5, row + 0.5));
    grid.add_scan(rays);
  };
  for (int scan = 0; scan < 20; ++scan) look(4.5);
  EXPECT_EQ(drawn(grid, 8, 3)[13], '#');
  for (int scan = 0; scan < 3; ++scan) look(6.5);
  EXPECT_EQ(drawn(grid, 8, 3).substr(9, 8), "......#?");
  for (int scan = 0; scan < 2; ++scan) look(4.5);
  EXPECT_EQ(drawn(grid, 8, 3)[13], '#');
}

// A wall one cell thick along which rays graze, each of its echoes off by a cell or so: rays that end farther
// on pass through its cells and do not wear it away.
TEST(EvidenceGrid, ThinWallSurvivesGrazingRays) {
  SlamOptions options;
  options.resolution_m = 0.02;
  EvidenceGrid grid(options);
  internal::CounterRng rng(7);
  const double wall_y = 0.31;
  for (int scan = 0; scan < 60; ++scan) {
    std::vector<EchoRay> rays;
    for (double bearing = 0.25; bearing < 1.5; bearing += 0.006) {
      const double range_m = wall_y / std::sin(bearing) + 0.06 * rng.uniform() - 0.03;
      rays.push_back({.from_map = {0.0, 0.0},
                      .to_map = {range_m * std::cos(bearing), range_m * std::sin(bearing)},
                      .noise_m = 0.052,
                      .follows = !rays.empty()});
    }
    grid.add_scan(rays);
    if (scan < 3) continue;
    for (int col = 5; col < 50; ++col)
      EXPECT_EQ(grid.at({.col = col, .row = static_cast<int>(wall_y / 0.02)}), Occupancy::occupied)
          << "scan " << scan << ", column " << col;
  }
}

}  // namespace
}  // namespace landfall
