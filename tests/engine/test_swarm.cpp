#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "engine/methods/pso/swarm.hpp"
#include "landfall/search.hpp"
#include "rooms.hpp"

namespace landfall {
namespace {

using Eigen::Vector3d;
using internal::Flight;
using internal::Particle;

// Equation 4: 0.7 v + 0.8 R1 (pbest - z) + 0.8 R2 (gbest - z); equation 5 adds it to z.
TEST(Swarm, MovesByHand) {
  Particle particle{.z = {1.0, 2.0, 0.5}, .v = {0.1, -0.2, 0.0}, .own_best = {2.0, 2.0, 0.0}, .own_fit = 3};
  internal::move(particle, {1.0, 4.0, 1.5}, {}, {0.5, 0.5, 1.0}, {0.25, 1.0, 0.5});
  EXPECT_TRUE(particle.v.isApprox(Vector3d(0.07 + 0.4, -0.14 + 1.6, -0.4 + 0.4), 1e-12)) << particle.v;
  EXPECT_TRUE(particle.z.isApprox(Vector3d(1.47, 3.46, 0.5), 1e-12)) << particle.z;
}

TEST(Swarm, StartsAsPublished) {
  const std::vector<Vector3d> start = internal::start_pattern({});
  ASSERT_EQ(start.size(), 40u);
  EXPECT_TRUE(start[0].isApprox(Vector3d(-0.5, 0.0, 0.0)));
  EXPECT_TRUE(start[9].isApprox(Vector3d(0.5, 0.0, 0.0)));
  EXPECT_TRUE(start[10].isApprox(Vector3d(0.0, -0.5, 0.0)));
  EXPECT_TRUE(start[19].isApprox(Vector3d(0.0, 0.5, 0.0)));
  EXPECT_TRUE(start[20].isApprox(Vector3d(0.0, 0.0, -50.0 * std::numbers::pi / 180.0)));
  EXPECT_TRUE(start[39].isApprox(Vector3d(0.0, 0.0, 50.0 * std::numbers::pi / 180.0)));
  EXPECT_NEAR(start[1].x() - start[0].x(), 1.0 / 9.0, 1e-12);
}

// A hill whose top is at (0.2, -0.1, 0.3).
std::int32_t hill(const Vector3d& z) {
  return static_cast<std::int32_t>(10'000.0 * std::exp(-10.0 * (z - Vector3d(0.2, -0.1, 0.3)).squaredNorm()));
}

TEST(Swarm, ClimbsToTheTopAndStopsThere) {
  const std::vector<Vector3d> start = internal::start_pattern({});
  const Flight flight = internal::fly(start, 10'000, hill, {}, {.seed = 1});
  EXPECT_GE(flight.fit, 9'500);  // f < 0.05
  EXPECT_LT(flight.iterations, 30);
  EXPECT_EQ(flight.fit, hill(flight.best));
  EXPECT_EQ(flight.poses_scored, 40 * (1 + flight.iterations));
  const Flight longer = internal::fly(start, 10'000, hill, {.good_enough = 0.0}, {.seed = 1});
  EXPECT_EQ(longer.iterations, 30);
  EXPECT_GE(longer.fit, flight.fit);
  EXPECT_LT((longer.best - Vector3d(0.2, -0.1, 0.3)).norm(), 0.02);
}

TEST(Swarm, FliesByItsKeyAlone) {
  const std::vector<Vector3d> start = internal::start_pattern({});
  const auto end = [&](const internal::FlightKey& key) {
    return internal::fly(start, 10'000, hill, {.good_enough = 0.0}, key).best;
  };
  EXPECT_EQ(end({.seed = 1, .scan = 2, .flight = 3}), end({.seed = 1, .scan = 2, .flight = 3}));
  EXPECT_NE(end({.seed = 1, .scan = 2, .flight = 3}), end({.seed = 2, .scan = 2, .flight = 3}));
  EXPECT_NE(end({.seed = 1, .scan = 2, .flight = 3}), end({.seed = 1, .scan = 3, .flight = 3}));
  EXPECT_NE(end({.seed = 1, .scan = 2, .flight = 3}), end({.seed = 1, .scan = 2, .flight = 4}));
}

class FreeMethods : public ::testing::TestWithParam<const char*> {
 protected:
  const PreparedMap map_{testing::furnished_room(), {.name = {}}};
  const Pose2 truth_{.x_m = 3.13, .y_m = 2.27, .theta_rad = 0.4};
  const Scan scan_ = testing::look(map_, testing::full_circle(180), truth_);
};

TEST_P(FreeMethods, FindTheRobotInAWindow) {
  const Window near{.T_map_robot = {3.0, 2.4, 0.5}, .half_x_m = 0.4, .half_y_m = 0.4, .half_theta_rad = 0.3};
  const SearchResult result = search(map_, {near}, scan_, {.method = GetParam(), .seed = 4});
  ASSERT_FALSE(result.hypotheses.empty());
  const Hypothesis& best = result.hypotheses.front();
  // The field is of cells' centres, half a cell behind the faces that the scan met.
  EXPECT_LT(translation_distance(best.T_map_robot, truth_), 0.08);
  EXPECT_LT(angle_distance(best.T_map_robot.theta_rad, truth_.theta_rad), 0.02);
  // The method's own pose is not bound to the lattice of 10 cm and half a degree.
  EXPECT_LT(translation_distance(best.T_map_robot_unrefined, truth_), 0.15);
  EXPECT_GT(best.score, 60);
  EXPECT_LE(best.score, 180);  // end points in occupied cells
  EXPECT_FALSE(result.proven);
}
INSTANTIATE_TEST_SUITE_P(All, FreeMethods,
                         ::testing::Values("pso", "icp", "icp_point_to_line", "angle_histogram"));

TEST(Pso, FindsTheRobotAnywhereAndTheSameOnAnyThreads) {
  const PreparedMap map(testing::furnished_room());
  const Pose2 T_map_truth{.x_m = 6.5, .y_m = 4.4, .theta_rad = -2.0};
  const Scan scan = testing::look(map, testing::full_circle(180), T_map_truth);
  const SearchResult one = search(map, {Anywhere{}}, scan, {.method = "pso", .threads = 1, .seed = 9});
  const SearchResult two = search(map, {Anywhere{}}, scan, {.method = "pso", .threads = 2, .seed = 9});
  ASSERT_FALSE(one.hypotheses.empty());
  EXPECT_LT(translation_distance(one.hypotheses.front().T_map_robot, T_map_truth), 0.05);
  ASSERT_EQ(one.hypotheses.size(), two.hypotheses.size());
  EXPECT_EQ(one.hypotheses.front().T_map_robot_unrefined, two.hypotheses.front().T_map_robot_unrefined);
  EXPECT_EQ(one.hypotheses.front().score, two.hypotheses.front().score);
}

}  // namespace
}  // namespace landfall
