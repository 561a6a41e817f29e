#include "engine/priors/domain.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "drawn_map.hpp"
#include "engine/base/thread_time.hpp"
#include "engine/maps/prepared_state.hpp"
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

// Oracle: every pose against the covariance, inverted as it is.
TEST(Domain, GaussiansEqualTheirDefinition) {
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    testing::Dice dice(seed, 11);
    const GridMap grid = testing::random_map(dice, 3, 150);
    const double m = grid.resolution_m * dice.one_of({0.5, 3.0, 20.0, 300.0});
    Eigen::Matrix3d factor;
    for (int i = 0; i < 9; ++i) factor(i / 3, i % 3) = dice.between(-1.0, 1.0);
    const Eigen::Matrix3d scale = Eigen::Vector3d(m, m, dice.between(0.2, 3.0)).asDiagonal();
    Eigen::Matrix3d covariance = scale * factor * factor.transpose() * scale;
    Gaussian gaussian{.T_map_robot = testing::random_pose(dice, grid), .covariance = {}};
    std::copy_n(covariance.data(), 9, gaussian.covariance.begin());
    const Question question(grid, {gaussian}, 0.7, grid.resolution_m * dice.between(1, 3));
    const double thin_m = grid.resolution_m * question.lattice.step_cells / 30.0;
    const double thin_rad = question.lattice.heading_step_rad() / 30.0;
    covariance.diagonal() += Eigen::Vector3d(thin_m, thin_m, thin_rad).cwiseAbs2();
    std::int64_t poses = 0;
    question.visit([&](const LatticePose& pose) {
      const int step = question.lattice.step_cells;
      if (pose.row % step != 0 || pose.col % step != 0) return;
      const Pose2 T_map_robot = question.lattice.T_map_robot(pose);
      const Eigen::Vector3d off(T_map_robot.x_m - gaussian.T_map_robot.x_m,
                                T_map_robot.y_m - gaussian.T_map_robot.y_m,
                                wrap_angle(T_map_robot.theta_rad - gaussian.T_map_robot.theta_rad));
      const double sigmas = std::sqrt(off.dot(covariance.ldlt().solve(off)));
      const bool free = grid.at({pose.col, pose.row}) == Occupancy::free;
      if (sigmas < 3.0 - 1e-6) {
        ASSERT_EQ(question.domain.contains(pose), free);
      }
      if (sigmas > 3.0 + 1e-6 && question.domain.components.size() == 1 &&
          question.domain.components.front().gaussian) {
        ASSERT_FALSE(question.domain.contains(pose));
      }
      poses += question.domain.contains(pose) ? 1 : 0;
    });
    EXPECT_EQ(poses, question.domain.poses);
  }
}

// Oracle: a point against every edge.
TEST(Domain, RegionsEqualTheirDefinition) {
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    testing::Dice dice(seed, 12);
    const GridMap grid = testing::random_map(dice, 3, 60);
    Region region;
    for (int i = dice.between(3, 40); i > 0; --i) {
      const Pose2 corner = testing::random_pose(dice, grid);
      region.polygon_map.push_back({corner.x_m, corner.y_m});
    }
    const Question question(grid, {region}, 3.0);
    std::int64_t inside_cells = 0;
    const auto inside = [&](const Point2& p) {
      bool odd = false;
      for (std::size_t i = 0; i < region.polygon_map.size(); ++i) {
        const Point2& a = region.polygon_map[i];
        const Point2& b = region.polygon_map[(i + 1) % region.polygon_map.size()];
        if ((a.y_m > p.y_m) == (b.y_m > p.y_m)) continue;
        if (p.x_m < a.x_m + (p.y_m - a.y_m) / (b.y_m - a.y_m) * (b.x_m - a.x_m)) odd = !odd;
      }
      return odd;
    };
    question.visit([&](const LatticePose& pose) {
      const bool in_polygon = inside(grid.center_of({pose.col, pose.row}));
      inside_cells += in_polygon ? 1 : 0;
      const bool free = grid.at({pose.col, pose.row}) == Occupancy::free;
      if (in_polygon) {
        ASSERT_EQ(question.domain.contains(pose), free);
      }
    });
    if (inside_cells > 0) {
      std::int64_t free_inside = 0;
      question.visit([&](const LatticePose& pose) {
        free_inside +=
            inside(grid.center_of({pose.col, pose.row})) && grid.at({pose.col, pose.row}) == Occupancy::free
                ? 1
                : 0;
      });
      EXPECT_EQ(question.domain.poses, free_inside);
    }
  }
}

TEST(Domain, VariancesOfAnySizeAreTaken) {
  const Question anywhere(room, {Anywhere{}});
  const Question wide(room, {Gaussian{{2.5, 1.5, 0.0}, {1e300, 0, 0, 0, 1e300, 0, 0, 0, 1e300}}});
  EXPECT_EQ(wide.domain.poses, anywhere.domain.poses);
  // Wide along x, a row high.
  const Question mixed(room, {Gaussian{{2.5, 2.5, 0.0}, {1e200, 0, 0, 0, 1e-200, 0, 0, 0, 1e-200}}});
  EXPECT_EQ(mixed.cells(0), "1,2 2,2 3,2 4,2 ");
  EXPECT_EQ(mixed.domain.poses, 4);
}

// What each costs must not be the product of corners, discs or poses with the cells of the map: minutes here.
TEST(Domain, LargePriorsOnLargeMapsAreQuick) {
  GridMap field{
      .width_cells = 1500, .height_cells = 1500, .resolution_m = 0.1, .T_map_grid = {}, .cells = {}};
  field.cells.assign(1500 * 1500, Occupancy::free);
  Region region;
  Beacons beacons;
  CandidatePoses poses;
  for (int i = 0; i < 20'000; ++i) {
    const double angle_rad = 2.0 * pi * i / 20'000;
    region.polygon_map.push_back({75.0 + 70.0 * std::cos(angle_rad), 75.0 + 70.0 * std::sin(angle_rad)});
    beacons.discs.push_back({region.polygon_map.back(), 0.3});
    poses.T_map_robot.push_back({region.polygon_map.back().x_m, region.polygon_map.back().y_m, 0.0});
  }
  const Gaussian gaussian{{75.0, 75.0, 0.0}, {900.0, 0, 0, 0, 900.0, 0, 0, 0, 9.0}};
  const double before_ms = internal::thread_time_ms();
  for (const PosePrior& prior :
       {PosePrior{region}, PosePrior{beacons}, PosePrior{poses}, PosePrior{gaussian}})
    EXPECT_GT(Question(field, prior, 0.05).domain.poses, 1000);
  EXPECT_LT(internal::thread_time_ms() - before_ms, 10'000.0);
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
