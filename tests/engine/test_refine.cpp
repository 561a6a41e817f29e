#include "engine/refine/refine.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

#include "random_world.hpp"
#include "rooms.hpp"

namespace landfall {
namespace {

using internal::EndPoints;
using internal::Lattice;
using internal::Refined;

// An L-shaped room with a free-standing wall, 9 m x 7 m, turned by 0.4 rad.
PreparedMap l_shaped_room() {
  const Pose2 T_map_room{12.0, -3.0, 0.4};
  const std::vector<Point2> corners{{0.0, 0.0}, {9.0, 0.0}, {9.0, 4.0}, {5.0, 4.0}, {5.0, 7.0}, {0.0, 7.0}};
  WallMap plan;
  for (std::size_t i = 0; i < corners.size(); ++i)
    plan.walls.push_back({T_map_room * corners[i], T_map_room * corners[(i + 1) % corners.size()]});
  plan.walls.push_back({T_map_room * Point2{6.0, 1.5}, T_map_room * Point2{6.0, 2.5}});
  return PreparedMap(plan, {.resolution_m = 0.05});
}

Eigen::Matrix3d covariance_of(const Refined& refined) {
  return Eigen::Map<const Eigen::Matrix3d>(refined.covariance.data());
}

// Refined from the lattice pose nearest to the truth.
Refined refine_at(const PreparedMap& map, const Scan& scan, const Pose2& T_map_robot,
                  double rotation_step_rad = 0.01) {
  const Lattice lattice = internal::make_lattice(map.grid(), 0.0, rotation_step_rad);
  const EndPoints points = internal::make_end_points(scan, map.grid().resolution_m);
  return internal::refine(map.state(), points, lattice, lattice.T_map_robot(lattice.nearest(T_map_robot)));
}

TEST(Refine, RecoversWhatLiesBetweenTheCells) {
  const PreparedMap map = l_shaped_room();
  double sum_m = 0.0;
  constexpr int places = 40;
  for (int i = 0; i < places; ++i) {
    const Pose2 T_map_robot = Pose2{12.0, -3.0, 0.4} * Pose2{1.0 + 0.0937 * i, 1.0 + 0.0413 * i, 0.1937 * i};
    const Scan scan = testing::look(map, testing::full_circle(360), T_map_robot);
    const Refined refined = refine_at(map, scan, T_map_robot);
    const double error_m = translation_distance(refined.T_map_robot, T_map_robot);
    EXPECT_LT(error_m, 0.012) << i;
    EXPECT_LT(angle_distance(refined.T_map_robot.theta_rad, T_map_robot.theta_rad), 0.003) << i;
    sum_m += error_m;
  }
  EXPECT_LT(sum_m / places, 0.006);
}

TEST(Refine, CovarianceIsSymmetricAndPositive) {
  for (std::uint64_t seed = 4000; seed < 4100; ++seed) {
    const testing::World world = testing::small_world(seed);
    const Lattice lattice = internal::make_lattice(world.map.grid(), 0.0, 0.05);
    const EndPoints points = internal::make_end_points(world.scan, world.map.grid().resolution_m);
    testing::Dice dice(seed, 50);
    const Refined refined =
        internal::refine(world.map.state(), points, lattice, testing::random_pose(dice, world.map.grid()));
    const Eigen::Matrix3d covariance = covariance_of(refined);
    EXPECT_EQ(covariance, covariance.transpose()) << seed;
    EXPECT_GT(Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(covariance).eigenvalues()[0], 0.0) << seed;
    EXPECT_GE(refined.share, 0.0);
    EXPECT_LE(refined.share, 1.0);
  }
}

TEST(Refine, StaysWithinOneAndAHalfSteps) {
  for (std::uint64_t seed = 4100; seed < 4200; ++seed) {
    const testing::World world = testing::small_world(seed);
    const GridMap& grid = world.map.grid();
    const Lattice lattice = internal::make_lattice(grid, 2.0 * grid.resolution_m, 0.05);
    const EndPoints points = internal::make_end_points(world.scan, grid.resolution_m);
    testing::Dice dice(seed, 51);
    const Pose2 T_map_start = testing::random_pose(dice, grid);
    const Pose2 T_start_refined =
        inverse(T_map_start) * internal::refine(world.map.state(), points, lattice, T_map_start).T_map_robot;
    const double reach_m =
        1.5 * 2.0 * grid.resolution_m * std::sqrt(2.0);  // a square's corner, in the grid's axes
    EXPECT_LE(std::hypot(T_start_refined.x_m, T_start_refined.y_m), reach_m + 1e-9) << seed;
    EXPECT_LE(std::abs(T_start_refined.theta_rad), 1.5 * lattice.heading_step_rad() + 1e-9) << seed;
  }
}

// A scanner of 8 m in the middle of 60 m of corridor: nothing tells where along it.
TEST(Refine, ACorridorLeavesItsAxisOpen) {
  for (const double axis_rad : {0.0, 0.5, 2.0}) {
    GridMap corridor = testing::empty_map(600, 30, 0.1, {5.0, 7.0, axis_rad});
    testing::fill(corridor, {0, 0}, {599, 0}, Occupancy::occupied);
    testing::fill(corridor, {0, 29}, {599, 29}, Occupancy::occupied);
    const PreparedMap map(corridor);
    const Pose2 T_map_robot = corridor.T_map_grid * Pose2{30.02, 1.53, 0.3};
    const Scan scan = testing::look(map, testing::full_circle(180, 8.0), T_map_robot);
    const Eigen::Matrix3d covariance = covariance_of(refine_at(map, scan, T_map_robot));
    const Eigen::Vector2d along(std::cos(axis_rad), std::sin(axis_rad));
    const Eigen::Vector2d across(-along.y(), along.x());
    const double along_m2 = along.dot(covariance.topLeftCorner<2, 2>() * along);
    const double across_m2 = across.dot(covariance.topLeftCorner<2, 2>() * across);
    EXPECT_GT(along_m2, 0.25);
    EXPECT_LT(across_m2, 0.02 * 0.02);
    EXPECT_LT(covariance(2, 2), 0.01 * 0.01);
  }
}

TEST(Refine, ARoomLeavesNothingOpen) {
  const PreparedMap map = l_shaped_room();
  const Pose2 T_map_robot = Pose2{12.0, -3.0, 0.4} * Pose2{2.0, 2.0, 0.0};
  const Eigen::Matrix3d covariance =
      covariance_of(refine_at(map, testing::look(map, testing::full_circle(360), T_map_robot), T_map_robot));
  EXPECT_LT(std::sqrt(covariance(0, 0)), 0.02);
  EXPECT_LT(std::sqrt(covariance(1, 1)), 0.02);
  EXPECT_LT(std::sqrt(covariance(2, 2)), 0.01);
}

}  // namespace
}  // namespace landfall
