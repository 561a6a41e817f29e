// Which of a method's best scores is the likeliest by its ranges, and how sure that is.
#include "engine/rank/range_posterior.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/rank/neighbourhoods.hpp"
#include "random_world.hpp"
#include "rooms.hpp"
#include "sonar_ring.hpp"

namespace landfall {
namespace {

using testing::Dice;

constexpr double degree = std::numbers::pi / 180.0;

SearchOptions options_of(const char* method) {
  return testing::grid_options(method, 0.12, 7.5);
}

struct Asked {
  Pose2 T_map_robot;
  Window window;
  Scan scan;
};

// Poses anywhere, the window's centre off by some cells.
Asked random_question(Dice& dice, const PreparedMap& map) {
  const auto ring = testing::sonar_ring(0.02);
  for (;;) {
    const Pose2 T_map_robot{dice.between(0.6, 7.4), dice.between(0.6, 5.4), dice.between(-3.1, 3.1)};
    if (!map.state().free_mask(0.3, 1)->contains(static_cast<int>(T_map_robot.x_m / 0.1),
                                                 static_cast<int>(T_map_robot.y_m / 0.1)))
      continue;
    const Pose2 T_map_centre{T_map_robot.x_m + dice.between(-0.7, 0.7),
                             T_map_robot.y_m + dice.between(-0.7, 0.7),
                             T_map_robot.theta_rad + dice.between(-0.7, 0.7)};
    return {T_map_robot, {T_map_centre, 0.8, 0.8, 45.0 * degree}, testing::look(map, ring, T_map_robot)};
  }
}

TEST(RangePosterior, ProbabilitiesAreSharesAndTheMeanIsNearerThanTheLattice) {
  const PreparedMap map(testing::furnished_room());
  Dice dice(3);
  double off_lattice_m = 0.0;
  double off_mean_m = 0.0;
  int found = 0;
  for (int i = 0; i < 30; ++i) {
    const Asked asked = random_question(dice, map);
    const SearchResult result = search(map, {asked.window}, asked.scan, options_of("grid"));
    ASSERT_FALSE(result.hypotheses.empty());
    double sum = 0.0;
    for (std::size_t k = 0; k < result.hypotheses.size(); ++k) {
      sum += result.hypotheses[k].probability;
      if (k > 0) {
        EXPECT_LE(result.hypotheses[k].probability, result.hypotheses[k - 1].probability);
      }
    }
    EXPECT_LE(sum, 1.0 + 1e-9);
    found += result.verdict == Verdict::found ? 1 : 0;
    const Hypothesis& best = result.hypotheses.front();
    off_lattice_m += translation_distance(best.T_map_robot_unrefined, asked.T_map_robot);
    off_mean_m += translation_distance(best.T_map_robot, asked.T_map_robot);
  }
  EXPECT_GE(found, 24);
  EXPECT_LT(off_mean_m, 0.75 * off_lattice_m);
}

TEST(RangePosterior, AsPublishedTheBestScoreComesFirst) {
  const PreparedMap map(testing::furnished_room());
  Dice dice(4);
  for (int i = 0; i < 20; ++i) {
    const Asked asked = random_question(dice, map);
    const SearchResult published = search(map, {asked.window}, asked.scan, options_of("grid_published"));
    const SearchResult ranked = search(map, {asked.window}, asked.scan, options_of("grid"));
    ASSERT_FALSE(published.hypotheses.empty());
    for (const Hypothesis& other : published.hypotheses)
      EXPECT_LE(other.score, published.hypotheses.front().score);
    for (const Hypothesis& other : ranked.hypotheses)
      EXPECT_LE(other.score, published.hypotheses.front().score);
  }
}

// Every reading is anything.
TEST(RangePosterior, ReadingsOfNoPlaceAreNotFound) {
  const PreparedMap map(testing::furnished_room());
  Dice dice(5);
  for (int i = 0; i < 20; ++i) {
    Asked asked = random_question(dice, map);
    for (float& range_m : asked.scan.ranges_m) range_m = static_cast<float>(dice.between(0.3, 7.0));
    EXPECT_NE(search(map, {asked.window}, asked.scan, options_of("grid")).verdict, Verdict::found) << i;
  }
}

TEST(Neighbourhoods, AreBlocksOfCellsAndRangesOfHeadingsInTheOrderOfScores) {
  const PreparedMap map(testing::empty_map(64, 64, 0.1));
  const internal::Lattice lattice = internal::make_lattice(map.grid(), 0.0, 5.0 * degree);
  const internal::Domain domain = internal::make_domain({Anywhere{}}, lattice, map.state().free_mask(0.0, 1));
  const Scan scan = testing::look(map, testing::full_circle(8), {3.0, 3.0, 0.0});
  const internal::EndPoints points = internal::make_end_points(scan, lattice.resolution_m);
  SearchOptions options;  // 10 degrees: two headings
  const internal::Query query{.map = map.state(),
                              .scan = scan,
                              .points = points,
                              .lattice = lattice,
                              .domain = domain,
                              .options = options,
                              .deadline = {}};
  const std::vector<internal::Candidate> candidates = {
      {.pose = {.heading = 0, .row = 3, .col = 3}, .score = 90},
      {.pose = {.heading = 0, .row = 9, .col = 3}, .score = 80},  // the block above
      {.pose = {.heading = 1, .row = 7, .col = 0}, .score = 70},  // with the first
      {.pose = {.heading = 2, .row = 3, .col = 3}, .score = 60},  // the next headings
      {.pose = {.heading = 0, .row = 0, .col = 0}, .score = 50},  // one too many of the first
  };
  using Places = std::vector<internal::Neighbourhood>;
  EXPECT_EQ(internal::neighbourhoods(query, candidates, 8, 2), (Places{{0, 2}, {1}, {3}}));
  EXPECT_EQ(internal::neighbourhoods(query, candidates, 1, 8), (Places{{0, 2, 4}}));
  options.distinct_rotation_rad = 1e12;
  EXPECT_EQ(internal::neighbourhoods(query, candidates, 8, 2), (Places{{0, 2}, {1}}));
}

}  // namespace
}  // namespace landfall
