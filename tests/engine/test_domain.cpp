#include "engine/domain.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

#include "drawn_map.hpp"
#include "engine/prepared_state.hpp"
#include "random_world.hpp"

namespace landfall {
namespace {

using internal::Domain;
using internal::Lattice;
using internal::LatticePose;
constexpr double pi = std::numbers::pi;
constexpr double nothing = -std::numeric_limits<double>::infinity();

struct Question {
  Lattice lattice;
  Domain domain;

  Question(const GridMap& grid, const PosePrior& prior, double rotation_step_rad = pi / 2,
           double translation_step_m = 0.0, double robot_radius_m = 0.0)
      : lattice(internal::make_lattice(grid, translation_step_m, rotation_step_rad)) {
    const PreparedMap map(grid);
    domain = internal::make_domain(prior, lattice, map.state().free_mask(robot_radius_m, lattice.step_cells));
  }
  // Cells of a heading as "col,row " from the lower left, row by row.
  [[nodiscard]] std::string cells(int heading) const {
    std::string list;
    for (int row = 0; row < lattice.height_cells; ++row)
      for (int col = 0; col < lattice.width_cells; ++col)
        if (domain.contains({.heading = heading, .row = row, .col = col}))
          list += std::to_string(col) + "," + std::to_string(row) + " ";
    return list;
  }
  [[nodiscard]] double probability(const LatticePose& pose) const {
    return std::exp(domain.log_prior(lattice, pose));
  }
  void visit(const std::function<void(const LatticePose&)>& visitor) const {
    for (int heading = 0; heading < lattice.headings; ++heading)
      for (int row = 0; row < lattice.height_cells; ++row)
        for (int col = 0; col < lattice.width_cells; ++col)
          visitor({.heading = heading, .row = row, .col = col});
  }
};

// Cell (col, row) has its centre at (col + 0.5, row + 0.5); seven cells are free.
const GridMap room = testing::drawn_map({"######",  //
                                         "#....#",  //
                                         "#..?.#",  //
                                         "######"});

TEST(Domain, AnywhereIsEveryFreeCellAtEveryHeading) {
  const Question question(room, {Anywhere{}});
  EXPECT_EQ(question.domain.poses, 28);
  for (int heading = 0; heading < 4; ++heading)
    EXPECT_EQ(question.cells(heading), "1,1 2,1 4,1 1,2 2,2 3,2 4,2 ");
  EXPECT_NEAR(question.probability({.heading = 3, .row = 2, .col = 3}), 1.0 / 28, 1e-12);
}

TEST(Domain, WindowHasABoxAndACone) {
  // Columns 1 to 3, their centres on the border; unknown (3, 1) is left out.
  const Question low(room, {Window{{2.5, 1.5, 0.1}, 1.0, 0.9, 0.1}});
  EXPECT_EQ(low.cells(0), "1,1 2,1 ");
  EXPECT_EQ(low.domain.poses, 2);
  const Question high(room, {Window{{2.5, 1.5, 0.1}, 1.0, 1.0, pi / 2}});  // headings 0 and 90 degrees
  EXPECT_EQ(high.cells(0), "1,1 2,1 1,2 2,2 3,2 ");
  EXPECT_EQ(high.cells(1), high.cells(0));
  EXPECT_EQ(high.cells(2) + high.cells(3), "");
  EXPECT_EQ(high.domain.poses, 10);
}

TEST(Domain, WindowIsAlignedWithTheMapAndNotTheGrid) {
  GridMap turned = room;
  turned.T_map_grid = {4.0, 0.0, pi / 2};  // cell (col, row) at x = 3.5 - row, y = col + 0.5
  const Question question(turned, {Window{{1.5, 2.5, pi / 2}, 0.2, 2.2, 0.1}});
  EXPECT_EQ(question.cells(0), "1,2 2,2 3,2 4,2 ");
  EXPECT_EQ(question.domain.poses, 4);
}

TEST(Domain, GaussianEndsAtThreeSigma) {
  const GridMap hall = testing::drawn_map({".....", ".....", ".....", ".....", "....."});
  // Sigma 0.5 m: neighbours at 2 sigma, diagonal ones at 2.83, next ones at 4. Heading 0 alone.
  const Question question(hall, {Gaussian{{2.5, 2.5, 0.0}, {0.25, 0, 0, 0, 0.25, 0, 0, 0, 0.01}}});
  EXPECT_EQ(question.cells(0), "1,1 2,1 3,1 1,2 2,2 3,2 1,3 2,3 3,3 ");
  EXPECT_EQ(question.domain.poses, 9);
  const double sum = 1.0 + 4.0 * std::exp(-2.0) + 4.0 * std::exp(-4.0);
  EXPECT_NEAR(question.probability({.heading = 0, .row = 2, .col = 2}), 1.0 / sum, 0.01);
  EXPECT_NEAR(question.probability({.heading = 0, .row = 2, .col = 1}), std::exp(-2.0) / sum, 0.01);
}

TEST(Domain, GaussianFollowsItsCorrelations) {
  const GridMap hall = testing::drawn_map({".....", ".....", ".....", ".....", "....."});
  // x and y nearly the same: the diagonal alone, two cells either way (2.83 m along, sigma 1.41).
  const Question diagonal(hall, {Gaussian{{2.5, 2.5, 0.0}, {1.0, 0.99, 0, 0.99, 1.0, 0, 0, 0, 0.01}}});
  EXPECT_EQ(diagonal.cells(0), "0,0 1,1 2,2 3,3 4,4 ");
  // A metre to the right for every quarter turn to the left.
  const Question turning(hall, {Gaussian{{1.5, 2.5, 0.0}, {1.0, 0, 1.57, 0, 0.01, 0, 1.57, 0, 2.4674}}});
  EXPECT_EQ(turning.cells(0), "1,2 ");
  EXPECT_EQ(turning.cells(1), "2,2 ");
  EXPECT_EQ(turning.cells(3), "0,2 ");
}

TEST(Domain, RegionIsAPolygon) {
  // Right of the line x + y = 4.2 and below y = 2.9.
  const Question question(room, {Region{{{4.0, 0.2}, {5.4, 0.2}, {5.4, 2.9}, {1.3, 2.9}}, pi, 0.2}});
  EXPECT_EQ(question.cells(2), "4,1 2,2 3,2 4,2 ");
  EXPECT_EQ(question.domain.poses, 4);
}

TEST(Domain, BeaconsAreDiscs) {
  const Question question(room, {Beacons{{{{1.5, 1.5}, 1.0}, {{4.5, 2.5}, 0.5}}}});
  EXPECT_EQ(question.cells(1), "1,1 2,1 1,2 4,2 ");
  EXPECT_EQ(question.domain.poses, 16);
}

TEST(Domain, CandidatesStandForTheNearestLatticePose) {
  const Question question(
      room, {CandidatePoses{
                {{1.9, 1.2, 0.3}, {1.6, 1.6, 0.1}, {2.1, 2.1, pi}, {3.5, 1.5, 0.0}, {99.0, 0.0, 0.0}}}});
  EXPECT_EQ(question.cells(0), "1,1 ");  // twice the same; (3, 1) is unknown
  EXPECT_EQ(question.cells(2), "2,2 ");
  EXPECT_EQ(question.domain.poses, 2);
  EXPECT_NEAR(question.probability({.heading = 2, .row = 2, .col = 2}), 0.5, 1e-12);
}

TEST(Domain, MixtureSharesWeightsOverItsComponents) {
  const PosePrior left{Window{{1.5, 1.5, 0.0}, 0.1, 0.1, 0.1}};  // (1, 1) at heading 0
  const PosePrior both{Window{{2.0, 1.5, 0.0}, 0.6, 0.1, 0.1}};  // (1, 1) and (2, 1)
  const PosePrior inner{Mixture{{1.0, 1.0}, {left, both}}};
  const Question question(room, {Mixture{{1.0, 3.0}, {inner, both}}});
  EXPECT_EQ(question.domain.poses, 2);
  EXPECT_NEAR(question.probability({.heading = 0, .row = 1, .col = 1}), 1.0 / 8 + 7.0 / 16, 1e-12);
  EXPECT_NEAR(question.probability({.heading = 0, .row = 1, .col = 2}), 7.0 / 16, 1e-12);
  EXPECT_EQ(question.domain.log_prior(question.lattice, {.heading = 0, .row = 2, .col = 2}), nothing);
}

TEST(Domain, ComponentsWithoutWeightOrFreeCellsLeaveTheirShareToTheOthers) {
  const PosePrior left{Window{{1.5, 1.5, 0.0}, 0.1, 0.1, 0.1}};
  const PosePrior wall{Window{{0.5, 0.5, 0.0}, 0.1, 0.1, 0.1}};
  const Question question(room, {Mixture{{0.0, 1.0, 2.0}, {{Anywhere{}}, left, wall}}});
  EXPECT_EQ(question.domain.poses, 1);
  EXPECT_NEAR(question.probability({.heading = 0, .row = 1, .col = 1}), 1.0, 1e-12);
}

TEST(Domain, ThinPriorsHoldTheNearestLatticePose) {
  for (const PosePrior& prior :
       {PosePrior{Window{{1.8, 1.2, 0.5}, 0.0, 0.0, 0.0}}, PosePrior{Gaussian{{1.8, 1.2, 0.5}, {}}},
        PosePrior{Region{{{1.7, 1.1}, {1.9, 1.1}, {1.8, 1.3}}, 0.5, 0.0}}}) {
    const Question question(room, prior);
    EXPECT_EQ(question.cells(0), "1,1 ");
    EXPECT_EQ(question.domain.poses, 1);
    EXPECT_NEAR(question.probability({.heading = 0, .row = 1, .col = 1}), 1.0, 1e-12);
  }
  EXPECT_EQ(Question(room, {Beacons{{{{1.8, 1.2}, 0.0}}}}).domain.poses, 4);
}

TEST(Domain, StepsOfSeveralCellsCountFromTheLowerLeft) {
  const Question question(room, {Anywhere{}}, pi / 2, 2.0);
  EXPECT_EQ(question.cells(0), "2,2 4,2 ");
  const Question thin(room, {Window{{3.0, 1.0, 0.0}, 0.1, 0.1, 0.0}}, pi / 2, 2.0);
  EXPECT_EQ(thin.cells(0), "");  // the nearest, (2, 0), is a wall
  EXPECT_TRUE(thin.domain.on_map);
}

TEST(Domain, RobotRadiusKeepsAwayFromWhatIsNotFree) {
  const GridMap hall = testing::drawn_map({".....",  //
                                           ".....",  //
                                           ".....",  //
                                           ".....",  //
                                           "?...."});
  EXPECT_EQ(Question(hall, {Anywhere{}}, pi / 2, 0.0, 0.9).domain.poses, 4 * 24);
  // Farther than 1.2 m from cell (0, 0) and, outside of the map, from its border's neighbours.
  EXPECT_EQ(Question(hall, {Anywhere{}}, pi / 2, 0.0, 1.2).cells(0), "1,1 2,1 3,1 1,2 2,2 3,2 1,3 2,3 3,3 ");
  EXPECT_EQ(Question(hall, {Anywhere{}}, pi / 2, 0.0, 1.5).cells(0), "2,1 3,1 1,2 2,2 3,2 1,3 2,3 3,3 ");
}

TEST(Domain, SaysWhetherThePriorTouchesTheMap) {
  EXPECT_TRUE(
      Question(room, {Window{{0.5, 0.5, 0.0}, 0.1, 0.1, 0.1}}).domain.on_map);  // a wall, yet on the map
  EXPECT_FALSE(Question(room, {Window{{50.0, 0.5, 0.0}, 1.0, 1.0, 0.1}}).domain.on_map);
  EXPECT_FALSE(Question(room, {Gaussian{{-50.0, 0.5, 0.0}, {1, 0, 0, 0, 1, 0, 0, 0, 1}}}).domain.on_map);
  EXPECT_FALSE(Question(room, {Region{{{0.0, 50.0}, {1.0, 50.0}, {1.0, 51.0}}}}).domain.on_map);
  EXPECT_FALSE(Question(room, {Beacons{{{{1e12, 0.0}, 1.0}}}}).domain.on_map);
  EXPECT_FALSE(Question(room, {CandidatePoses{{{4294967296.0, 1.5, 0.0}}}}).domain.on_map);
}

// Oracle: every pose asked one by one.
TEST(Domain, WindowsAndBeaconsEqualTheirDefinition) {
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    testing::Dice dice(seed, 9);
    const GridMap grid = testing::random_map(dice, 5, 40);
    const double size_m = grid.resolution_m * grid.width_cells;
    const Window window{testing::random_pose(dice, grid), dice.between(0.1, 0.5) * size_m,
                        dice.between(0.1, 0.5) * size_m, dice.between(0.5, 3.2)};
    const Beacon disc{{window.T_map_robot.x_m, window.T_map_robot.y_m}, 0.3 * size_m};
    const Question in_window(grid, {window}, 0.4);
    const Question in_disc(grid, {Beacons{{disc}}}, 0.4);
    in_window.visit([&](const LatticePose& pose) {
      const Pose2 T_map_robot = in_window.lattice.T_map_robot(pose);
      const bool free = grid.at({pose.col, pose.row}) == Occupancy::free;
      const double dx_m = std::abs(T_map_robot.x_m - disc.p_map.x_m);
      const double dy_m = std::abs(T_map_robot.y_m - disc.p_map.y_m);
      const bool turned_so =
          angle_distance(T_map_robot.theta_rad, window.T_map_robot.theta_rad) <= window.half_theta_rad;
      ASSERT_EQ(in_window.domain.contains(pose),
                free && turned_so && dx_m <= window.half_x_m && dy_m <= window.half_y_m);
      ASSERT_EQ(in_disc.domain.contains(pose), free && std::hypot(dx_m, dy_m) <= disc.radius_m);
    });
  }
}

TEST(Domain, PriorSumsToOneOverItsPoses) {
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    testing::Dice dice(seed, 10);
    const GridMap grid = testing::random_map(dice, 1, 30);
    const Question question(grid, testing::random_prior(dice, grid), dice.between(0.2, 3.0),
                            grid.resolution_m * dice.between(1, 3));
    std::int64_t poses = 0;
    double sum = 0.0;
    question.visit([&](const LatticePose& pose) {
      const double probability = question.probability(pose);
      EXPECT_EQ(probability > 0.0, question.domain.contains(pose));
      poses += question.domain.contains(pose) ? 1 : 0;
      sum += probability;
    });
    EXPECT_EQ(poses, question.domain.poses);
    if (poses > 0) {
      EXPECT_NEAR(sum, 1.0, 1e-9);
    }
  }
}

}  // namespace
}  // namespace landfall
