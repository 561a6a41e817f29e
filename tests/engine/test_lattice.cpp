#include "engine/priors/lattice.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "drawn_map.hpp"
#include "landfall/error.hpp"

namespace landfall {
namespace {

using internal::Lattice;
using internal::LatticePose;
using internal::make_lattice;
constexpr double pi = std::numbers::pi;

// Four columns, three rows of half a metre, turned a quarter to the left.
const GridMap grid = testing::drawn_map({"....", "....", "...."}, 0.5, {10.0, 20.0, pi / 2});

TEST(Lattice, CountsHeadingsOfAFullTurn) {
  EXPECT_EQ(make_lattice(grid, 0.0, pi / 360).headings, 720);
  EXPECT_EQ(make_lattice(grid, 0.0, 0.01).headings, 629);  // 628.3 steps
  EXPECT_EQ(make_lattice(grid, 0.0, 2 * pi).headings, 1);
  for (int n = 1; n <= 36'000; n += 7) ASSERT_EQ(make_lattice(grid, 0.0, 2 * pi / n).headings, n);
}

TEST(Lattice, HeadingsLieInTheHalfOpenTurn) {
  const Lattice lattice = make_lattice(grid, 0.0, pi / 4);
  EXPECT_EQ(lattice.heading_grid_rad(0), 0.0);
  EXPECT_DOUBLE_EQ(lattice.heading_grid_rad(1), pi / 4);
  EXPECT_DOUBLE_EQ(lattice.heading_grid_rad(4), pi);
  EXPECT_DOUBLE_EQ(lattice.heading_grid_rad(5), -3 * pi / 4);
}

TEST(Lattice, PosesAreCentresOfCellsAlongTheGridsAxes) {
  const Lattice lattice = make_lattice(grid, 0.0, pi / 2);
  // Grid frame: (1.25, 0.75), 90 degrees; the grid's x is the map's y, its y the map's -x.
  const Pose2 T_map_robot = lattice.T_map_robot({.heading = 1, .row = 1, .col = 2});
  EXPECT_NEAR(T_map_robot.x_m, 10.0 - 0.75, 1e-12);
  EXPECT_NEAR(T_map_robot.y_m, 20.0 + 1.25, 1e-12);
  EXPECT_NEAR(T_map_robot.theta_rad, pi, 1e-12);
}

TEST(Lattice, NearestInvertsEveryPose) {
  for (const double translation_step_m : {0.5, 1.0}) {
    const Lattice lattice = make_lattice(grid, translation_step_m, 0.3);
    for (int heading = 0; heading < lattice.headings; ++heading)
      for (int row = 0; row < 3; row += lattice.step_cells)
        for (int col = 0; col < 4; col += lattice.step_cells) {
          const LatticePose pose{.heading = heading, .row = row, .col = col};
          ASSERT_EQ(lattice.nearest(lattice.T_map_robot(pose)), pose);
        }
  }
}

TEST(Lattice, NearestRoundsToTheStep) {
  const GridMap level = testing::drawn_map({"........", "........"}, 1.0);
  const Lattice lattice = make_lattice(level, 3.0, pi / 2);
  EXPECT_EQ(lattice.nearest({1.9, 0.5, 0.7}), (LatticePose{.heading = 0, .row = 0, .col = 0}));
  EXPECT_EQ(lattice.nearest({2.1, 0.5, 0.8}), (LatticePose{.heading = 1, .row = 0, .col = 3}));
  EXPECT_EQ(lattice.nearest({5.1, 0.5, -0.8}), (LatticePose{.heading = 3, .row = 0, .col = 6}));
  EXPECT_EQ(lattice.nearest({-1.1, 0.5, pi}), (LatticePose{.heading = 2, .row = 0, .col = -3}));
}

TEST(Lattice, NearestOfAFarPoseIsOffTheGrid) {
  const Lattice lattice = make_lattice(grid, 0.0, pi / 2);
  for (const double far_m : {1e5, 2147483648.0, -2147483648.0, 1e18, 1e300, -1e300})
    EXPECT_FALSE(lattice.contains(lattice.nearest({far_m, 20.5, 0.0}))) << far_m;
}

TEST(Lattice, RefusesStepsThatFitNoGrid) {
  for (const double step_m : {-0.5, 0.2, 0.75, 1e9, std::nan("")})
    EXPECT_THROW(make_lattice(grid, step_m, 0.1), Error) << step_m;
  for (const double step_rad : {0.0, -0.1, 1e-5, 6.3, std::nan("")})
    EXPECT_THROW(make_lattice(grid, 0.0, step_rad), Error) << step_rad;
  EXPECT_EQ(make_lattice(grid, 1.5, 0.1).step_cells, 3);
  try {
    make_lattice(grid, 0.0, 1e-9);
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("rotation_step_rad is 1e-09"), std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace landfall
