// Reduced grids: drawn at their resolution, and finding what the full search finds.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "drawing.hpp"
#include "drawn_map.hpp"
#include "engine/methods/grid/reduced.hpp"
#include "landfall/error.hpp"
#include "landfall/grid_matching.hpp"
#include "random_world.hpp"
#include "rooms.hpp"

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

std::shared_ptr<const Sensor> sonar_ring() {
  Sensor sensor{.name = "ring", .beams = {}, .range_noise_m = 0.0};
  for (int k = 0; k < 14; ++k) {
    const double axis_rad = k * 2.0 * std::numbers::pi / 14.0;
    sensor.beams.push_back({.T_robot_beam = {0.3 * std::cos(axis_rad), 0.3 * std::sin(axis_rad), axis_rad},
                            .half_angle_rad = 6.0 * degree,
                            .range_max_m = 8.0});
  }
  return std::make_shared<const Sensor>(sensor);
}

SearchOptions as_published(const char* method) {
  return {.method = method,
          .translation_step_m = 0.1,
          .rotation_step_rad = 5.0 * degree,
          .robot_radius_m = 0.3,
          .distinct_translation_m = 0.1,
          .distinct_rotation_rad = 7.0 * degree};
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
  const auto ring = sonar_ring();
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
    result.poses_full += full.counts.poses_scored;
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
      search(map, {Anywhere{}}, testing::look(map, sonar_ring(), {4.0, 2.0, 1.0}), options);
  EXPECT_TRUE(result.hypotheses.empty());
  EXPECT_EQ(result.verdict, Verdict::lost);
}

TEST(GridMatchingTimes, AreThoseOfTheSteps) {
  const PreparedMap map(testing::furnished_room());
  const Scan scan = testing::look(map, sonar_ring(), {4.0, 2.0, 1.0});
  const GridMatchingTimes times = time_grid_matching(map, {Anywhere{}}, scan, as_published("grid"), 3);
  EXPECT_GT(times.local_grids_ms, 0.0);
  EXPECT_GT(times.matching_ms, 0.0);
  EXPECT_THROW((void)time_grid_matching(map, {Anywhere{}}, scan, as_published("grid"), 0), Error);
}

}  // namespace
}  // namespace landfall
