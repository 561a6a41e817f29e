// Method `grid` as search() asks it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/methods/grid/local_grid.hpp"
#include "engine/methods/table.hpp"
#include "engine/priors/central_heading.hpp"
#include "random_world.hpp"
#include "rooms.hpp"
#include "same_answer.hpp"
#include "sonar_ring.hpp"

namespace landfall {
namespace {

using internal::Candidate;
using testing::Dice;

constexpr double degree = std::numbers::pi / 180.0;
const char* const grid_methods[] = {"grid", "grid_uncorrected", "grid_turned"};

// Equation (1) as it is written: over all cells of the local grid, one pose after the other.
class DirectSum {
 public:
  DirectSum(const PreparedMap& map, const Scan& scan, const internal::Lattice& lattice, double robot_radius_m,
            bool turned)
      : map_(map.grid()), lattice_(lattice), turned_(turned) {
    model_ = {.cones = internal::make_cones(scan, lattice.resolution_m,
                                            std::hypot(lattice.width_cells, lattice.height_cells) + 1.0),
              .robot_radius_cells = robot_radius_m / lattice.resolution_m};
  }

  [[nodiscard]] std::int32_t at(const internal::LatticePose& pose, bool corrected) const {
    const double heading_rad = lattice_.heading_grid_rad(pose.heading);
    internal::LocalGrid local;
    internal::LocalGridPainter(model_).paint(turned_ ? 0.0 : heading_rad, local);
    if (turned_) local = internal::turned_raster(local, heading_rad);
    std::int32_t sum = 0;
    for (std::size_t i = 0; i < local.cells.size(); ++i)
      sum += local.weights[i] *
             value({.col = pose.col + local.cells[i].col, .row = pose.row + local.cells[i].row}, corrected);
    return sum;
  }

 private:
  [[nodiscard]] int value(CellIndex cell, bool corrected) const {
    if (map_.at(cell) != Occupancy::occupied) return map_.at(cell) == Occupancy::free ? -1 : 0;
    if (!corrected) return 1;
    for (const CellIndex to : {CellIndex{0, 1}, CellIndex{1, 0}, CellIndex{0, -1}, CellIndex{-1, 0}})
      if (map_.at({.col = cell.col + to.col, .row = cell.row + to.row}) != Occupancy::occupied) return 1;
    return 0;
  }

  const GridMap& map_;
  internal::Lattice lattice_;
  internal::LocalModel model_;
  bool turned_;
};

TEST(Grid, ScoresEqualTheDirectSum) {
  int compared = 0;
  for (int seed = 0; seed < 40; ++seed) {
    SCOPED_TRACE(seed);
    Dice dice(static_cast<std::uint64_t>(seed), 7);
    const PreparedMap map(testing::random_map(dice, 5, 60));
    Scan scan = testing::random_scan(dice, map, 30);
    Sensor sensor = *scan.sensor;
    for (Beam& beam : sensor.beams)
      if (dice.chance(0.7)) beam.half_angle_rad = dice.between(0.0, 0.4);
    scan.sensor = std::make_shared<const Sensor>(sensor);
    SearchOptions options = testing::random_options(dice, map.grid());
    const PosePrior prior = testing::random_prior(dice, map.grid());
    const char* method = grid_methods[seed % 3];
    const internal::Lattice lattice = internal::centered_on(
        prior, internal::make_lattice(map.grid(), options.translation_step_m, options.rotation_step_rad));
    const internal::Domain domain = internal::make_domain(
        prior, lattice, map.state().free_mask(options.robot_radius_m, lattice.step_cells));
    if (domain.poses == 0 || domain.poses > 20'000) continue;
    const internal::EndPoints points = internal::make_end_points(scan, lattice.resolution_m);
    const internal::Proposal proposal = internal::find_method(method).propose({.map = map.state(),
                                                                               .scan = scan,
                                                                               .points = points,
                                                                               .lattice = lattice,
                                                                               .domain = domain,
                                                                               .options = options,
                                                                               .threads = 2,
                                                                               .deadline = {}});
    const DirectSum direct(map, scan, lattice, options.robot_radius_m, seed % 3 == 2);
    EXPECT_TRUE(proposal.proven);
    EXPECT_EQ(proposal.counts.poses_scored, domain.poses);
    for (std::size_t i = 0; i < proposal.candidates.size(); i += 17, ++compared)
      EXPECT_EQ(proposal.candidates[i].score, direct.at(proposal.candidates[i].pose, seed % 3 != 1));
    if (domain.poses > 2000) continue;
    Candidate best;
    for (int k = 0; k < lattice.headings; ++k)
      for (int row = 0; row < lattice.height_cells; ++row)
        for (int col = 0; col < lattice.width_cells; ++col) {
          const internal::LatticePose pose{.heading = k, .row = row, .col = col};
          if (!domain.contains(pose)) continue;
          const Candidate one{.pose = pose, .score = direct.at(pose, seed % 3 != 1)};
          if (one.score > 0 && (best.score == 0 || better(one, best))) best = one;
        }
    ASSERT_EQ(proposal.candidates.empty(), best.score == 0);
    if (best.score == 0) continue;
    EXPECT_EQ(proposal.candidates.front().score, best.score);
    EXPECT_EQ(proposal.candidates.front().pose, best.pose);
  }
  EXPECT_GT(compared, 500);
}

SearchOptions as_published(const char* method) {
  return testing::grid_options(method, 0.15, 7.5);
}

TEST(Grid, ThePublishedWindowHas289Times19Poses) {
  const PreparedMap map(testing::empty_map(100, 100, 0.1));
  const double theta_rad = 0.123;  // no multiple of the step
  const Window window{{5.05, 5.05, theta_rad}, 0.8, 0.8, 45.0 * degree};
  const Scan scan{.sensor = testing::sonar_ring(), .ranges_m = std::vector<float>(14, 2.0F)};
  SearchOptions options = as_published("grid");
  const SearchResult result = search(map, {window}, scan, options);
  EXPECT_EQ(result.counts.poses_covered, 289 * 19);
  EXPECT_EQ(result.counts.poses_scored, 289 * 19);
  for (const Hypothesis& one : result.hypotheses) {
    const double steps = (one.T_map_robot_unrefined.theta_rad - theta_rad) / (5.0 * degree);
    EXPECT_NEAR(steps, std::round(steps), 1e-9);
  }
}

TEST(Grid, FindsSonarsOnTheLatticeInAFurnishedRoom) {
  const PreparedMap map(testing::furnished_room());
  const auto ring = testing::sonar_ring();
  Dice dice(11);
  int right = 0;
  constexpr int asked = 40;
  for (int i = 0; i < asked; ++i) {
    Pose2 T_map_robot;
    do
      T_map_robot = {dice.between(5, 74) * 0.1 + 0.05, dice.between(5, 54) * 0.1 + 0.05,
                     dice.between(-3.1, 3.1)};
    while (!map.state().free_mask(0.3, 1)->contains(static_cast<int>(T_map_robot.x_m / 0.1),
                                                    static_cast<int>(T_map_robot.y_m / 0.1)));
    const Window window{
        {T_map_robot.x_m + 0.1 * dice.between(-8, 8), T_map_robot.y_m + 0.1 * dice.between(-8, 8),
         T_map_robot.theta_rad + 5.0 * degree * dice.between(-9, 9)},
        0.8,
        0.8,
        45.0 * degree};
    const SearchResult result =
        search(map, {window}, testing::look(map, ring, T_map_robot), as_published("grid"));
    ASSERT_FALSE(result.hypotheses.empty());
    const Pose2& T_map_found = result.hypotheses.front().T_map_robot_unrefined;
    right += translation_distance(T_map_found, T_map_robot) <= 0.101 &&
                     angle_distance(T_map_found.theta_rad, T_map_robot.theta_rad) <= 7.0 * degree
                 ? 1
                 : 0;
  }
  EXPECT_GE(right, asked - 2);
}

TEST(Grid, FindsALaserInAWindow) {
  const PreparedMap map(testing::furnished_room());
  const Pose2 T_map_robot{2.31, 3.17, 0.4};
  const Scan scan = testing::look(map, testing::full_circle(120), T_map_robot);
  const SearchResult result = search(map, {Window{{2.6, 3.0, 0.5}, 0.8, 0.8, 0.5}}, scan,
                                     {.method = "grid", .rotation_step_rad = 0.02});
  ASSERT_FALSE(result.hypotheses.empty());
  EXPECT_LT(translation_distance(result.hypotheses.front().T_map_robot, T_map_robot), 0.05);
  EXPECT_LT(angle_distance(result.hypotheses.front().T_map_robot.theta_rad, T_map_robot.theta_rad), 0.01);
}

TEST(Grid, AnswersDoNotDependOnThreads) {
  const PreparedMap map(testing::furnished_room());
  const Scan scan = testing::look(map, testing::sonar_ring(), {4.0, 2.0, 1.0});
  for (const char* method : grid_methods) {
    SearchOptions options = as_published(method);
    options.threads = 1;
    const SearchResult one = search(map, {Anywhere{}}, scan, options);
    options.threads = 0;
    testing::expect_same_answer(search(map, {Anywhere{}}, scan, options), one);
  }
}

TEST(Grid, ABudgetIsKept) {
  const PreparedMap map(testing::furnished_room());
  const Scan scan = testing::look(map, testing::sonar_ring(), {4.0, 2.0, 1.0});
  SearchOptions options = as_published("grid");
  options.time_budget_s = 1e-9;
  const SearchResult result = search(map, {Anywhere{}}, scan, options);
  EXPECT_FALSE(result.proven);
  EXPECT_NE(result.verdict, Verdict::found);
}

}  // namespace
}  // namespace landfall
