// Reduced grids: drawn at their resolution, and finding what the full search finds.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "drawing.hpp"
#include "drawn_map.hpp"
#include "engine/methods/grid/block_bounds.hpp"
#include "engine/methods/grid/reduced.hpp"
#include "engine/methods/grid/time_matching.hpp"
#include "landfall/error.hpp"
#include "random_world.hpp"
#include "rooms.hpp"
#include "sonar_ring.hpp"

namespace landfall {
namespace {

using internal::Contours;
using testing::Dice;

constexpr double degree = std::numbers::pi / 180.0;

TEST(GridReduced, LargeCellsAreOccupiedWhereAnObstacleReachesIn) {
  const GridMap map = testing::drawn_map({"??..#",  //
                                          "?...#",  //
                                          "....#",  //
                                          ".#...",  //
                                          "....."});
  EXPECT_EQ(testing::drawing_of(internal::draw_reduced(map, 2)), (std::vector<std::string>{"?.#",  //
                                                                                           "..#",  //
                                                                                           "#.."}));
  EXPECT_EQ(internal::draw_reduced(map, 2).resolution_m, 2.0 * map.resolution_m);
}

// A block of 8 x 8 cells from (2, 2) on: at half the resolution its contour is one large cell thick and its
// inside unknown. Cells merged by fours from the corrected grid would have none that are unknown.
TEST(GridReduced, ContoursAreCorrectedAtTheReducedResolution) {
  GridMap map = testing::empty_map(12, 12, 0.1);
  testing::fill(map, {2, 2}, {9, 9}, Occupancy::occupied);
  const std::vector<std::int8_t> cells =
      internal::global_grid(internal::draw_reduced(map, 2), Contours::corrected);
  ASSERT_EQ(cells.size(), 36u);
  for (int row = 0; row < 6; ++row)
    for (int col = 0; col < 6; ++col) {
      const bool within = row >= 1 && row <= 4 && col >= 1 && col <= 4;
      const bool inside = row >= 2 && row <= 3 && col >= 2 && col <= 3;
      const int expected = inside ? 0 : within ? 1 : -1;
      EXPECT_EQ(cells[static_cast<std::size_t>(6 * row + col)], expected) << row << ", " << col;
    }
}

SearchOptions as_published(const char* method) {
  return testing::grid_options(method, 0.1, 7.0);
}

struct Compared {
  int asked = 0;
  int same = 0;
  std::int64_t poses_full = 0;
  std::int64_t poses_reduced = 0;
};

// Full and reduced search of sonars in a furnished room, under a prior around each pose.
template <typename PriorAround>
Compared compare(int asked, const PriorAround& prior_around) {
  const PreparedMap map(testing::furnished_room());
  const auto ring = testing::sonar_ring();
  Dice dice(5);
  Compared result;
  while (result.asked < asked) {
    const Pose2 T_map_robot{dice.between(0.6, 7.4), dice.between(0.6, 5.4), dice.between(-3.1, 3.1)};
    if (!map.state().free_mask(0.3, 1)->contains(static_cast<int>(T_map_robot.x_m / 0.1),
                                                 static_cast<int>(T_map_robot.y_m / 0.1)))
      continue;
    const PosePrior prior = prior_around(T_map_robot);
    const Scan scan = testing::look(map, ring, T_map_robot);
    const SearchResult full = search(map, prior, scan, as_published("grid"));
    const SearchResult reduced = search(map, prior, scan, as_published("grid_reduced"));
    EXPECT_FALSE(reduced.proven);
    ++result.asked;
    result.poses_full += full.counts.poses_covered;
    result.poses_reduced += reduced.counts.poses_scored;
    if (reduced.hypotheses.empty() || full.hypotheses.empty()) continue;
    result.same +=
        reduced.hypotheses.front().T_map_robot_unrefined == full.hypotheses.front().T_map_robot_unrefined ? 1
                                                                                                          : 0;
  }
  return result;
}

TEST(GridReduced, FindsWhatTheFullSearchFindsInNineteenCasesOfTwenty) {
  const Compared window = compare(60, [](const Pose2& T_map_robot) {
    return PosePrior{Window{{T_map_robot.x_m + 0.3, T_map_robot.y_m - 0.2, T_map_robot.theta_rad + 0.2},
                            0.8,
                            0.8,
                            45.0 * degree}};
  });
  EXPECT_GE(window.same, 57);
}

TEST(GridReduced, ScoresFewPosesOfAWholeMap) {
  const Compared anywhere = compare(10, [](const Pose2&) { return PosePrior{Anywhere{}}; });
  EXPECT_GE(anywhere.same, 9);
  EXPECT_LT(anywhere.poses_reduced, anywhere.poses_full / 2);
}

TEST(GridReduced, ABudgetThatEndsOnTheWayAnswersNothing) {
  const PreparedMap map(testing::furnished_room());
  SearchOptions options = as_published("grid_reduced");
  options.time_budget_s = 1e-9;
  const SearchResult result =
      search(map, {Anywhere{}}, testing::look(map, testing::sonar_ring(), {4.0, 2.0, 1.0}), options);
  EXPECT_TRUE(result.hypotheses.empty());
  EXPECT_EQ(result.verdict, Verdict::lost);
}

// Over maps, scans and priors of all kinds: blocks that are left out hold no rival.
TEST(GridBounds, LeaveOutNoRival) {
  std::int64_t asked = 0;
  std::int64_t left = 0;
  for (int seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE(seed);
    Dice dice(static_cast<std::uint64_t>(seed), 11);
    const PreparedMap map(seed % 2 == 0 ? testing::furnished_room() : testing::random_map(dice, 5, 60));
    Scan scan = testing::random_scan(dice, map, 30);
    Sensor sensor = *scan.sensor;
    for (Beam& beam : sensor.beams)
      if (dice.chance(0.7)) beam.half_angle_rad = dice.between(0.0, 0.4);
    scan.sensor = std::make_shared<const Sensor>(sensor);
    SearchOptions options = testing::random_options(dice, map.grid());
    options.rotation_step_rad = std::max(options.rotation_step_rad, 0.2);
    const PosePrior prior = testing::random_prior(dice, map.grid());
    const internal::Lattice lattice = internal::make_lattice(map.grid(), 0.0, options.rotation_step_rad);
    const internal::Domain domain =
        internal::make_domain(prior, lattice, map.state().free_mask(options.robot_radius_m, 1));
    if (domain.poses == 0) continue;
    const internal::EndPoints points = internal::make_end_points(scan, lattice.resolution_m);
    const internal::Query query{.map = map.state(),
                                .scan = scan,
                                .points = points,
                                .lattice = lattice,
                                .domain = domain,
                                .options = options,
                                .threads = 2,
                                .deadline = {}};
    const internal::LocalModel model = internal::make_local_model(scan, lattice, options.robot_radius_m);
    const std::vector<std::int8_t>& global = map.state().global_grid(Contours::corrected);
    const auto level_of = [&](const std::vector<internal::SharedMask>& masks) {
      return internal::GridLevel{.query = query,
                                 .lattice = lattice,
                                 .mask_of_heading = masks,
                                 .global = global,
                                 .model = model,
                                 .rival_share = 0.1};
    };
    const internal::GridLevel level = level_of(domain.mask_of_heading);
    const internal::LevelScores full = internal::score_level(level);
    const std::int32_t best = full.rivals.empty() ? 0 : full.rivals.front().score;
    const internal::BoundedPoses bounded =
        internal::poses_within_bounds(level, internal::lowest_rival(best, internal::rival_margin(level)));
    const internal::LevelScores within = internal::score_level(level_of(bounded.mask_of_heading));
    ASSERT_EQ(within.rivals.size(), full.rivals.size());
    for (std::size_t i = 0; i < full.rivals.size(); ++i) {
      EXPECT_EQ(within.rivals[i].pose, full.rivals[i].pose);
      EXPECT_EQ(within.rivals[i].score, full.rivals[i].score);
    }
    asked += full.poses_scored;
    left += within.poses_scored;
  }
  EXPECT_LT(left, asked * 3 / 4);
}

TEST(GridBounds, AWholeMapIsSearchedWithinBoundsAndProven) {
  const PreparedMap map(testing::furnished_room());
  const Scan scan = testing::look(map, testing::sonar_ring(), {4.0, 2.0, 1.0});
  SearchOptions options = as_published("grid");
  options.rotation_step_rad = 0.3 * degree;  // more than four million poses
  const SearchResult bounded = search(map, {Anywhere{}}, scan, options);
  EXPECT_NE(bounded.method.find("bounds"), std::string::npos) << bounded.method;
  EXPECT_TRUE(bounded.proven);
  EXPECT_GT(bounded.counts.bounds_computed, 0);
  EXPECT_LT(bounded.counts.poses_scored, bounded.counts.poses_covered * 3 / 4);
}

TEST(GridMatchingTimes, AreThoseOfTheSteps) {
  const PreparedMap map(testing::furnished_room());
  const Scan scan = testing::look(map, testing::sonar_ring(), {4.0, 2.0, 1.0});
  const internal::GridMatchingTimes times =
      internal::time_grid_matching(map, {Anywhere{}}, scan, as_published("grid"), 3);
  EXPECT_GT(times.local_grids_ms, 0.0);
  EXPECT_GT(times.matching_ms, 0.0);
  EXPECT_THROW((void)internal::time_grid_matching(map, {Anywhere{}}, scan, as_published("grid"), 0), Error);
}

}  // namespace
}  // namespace landfall
