// Guesses from a batch's own answers: where they lead, and that answers do not depend on them.
#include <gtest/gtest.h>

#include "engine/guess.hpp"
#include "random_world.hpp"
#include "same_answer.hpp"

namespace landfall {
namespace {

using internal::Answers;

Scan at_odometry(const Pose2& T_odom_robot) {
  return {.T_odom_robot = T_odom_robot};
}

SearchResult found_at(const Pose2& T_map_robot) {
  SearchResult result;
  Hypothesis& first = result.hypotheses.emplace_back();
  first.T_map_robot = T_map_robot;
  first.score = 3000;
  first.map_index = 1;
  result.beams_echo = 20;
  return result;
}

TEST(Answers, LeadByOdometryFromTheNearestScanBefore) {
  const std::vector<Scan> scans{at_odometry({5.0, 0.0, 0.0}), at_odometry({6.0, 0.0, 0.0}),
                                at_odometry({7.0, 0.0, 0.0}), at_odometry({7.0, 1.0, 0.5})};
  std::vector<SearchResult> results(scans.size());
  Answers answers(scans, results);
  EXPECT_FALSE(answers.guess(3));
  answers.give(0, found_at({}));
  answers.give(1, found_at({1.0, 2.0, std::numbers::pi / 2}));
  EXPECT_FALSE(answers.guess(0));
  const auto guess = answers.guess(3);
  ASSERT_TRUE(guess);
  // One to the front and one to the left, as the robot stood at scan 1.
  EXPECT_NEAR(guess->T_map_robot.x_m, 0.0, 1e-12);
  EXPECT_NEAR(guess->T_map_robot.y_m, 3.0, 1e-12);
  EXPECT_NEAR(guess->T_map_robot.theta_rad, std::numbers::pi / 2 + 0.5, 1e-12);
  EXPECT_EQ(guess->map_index, 1);
  EXPECT_DOUBLE_EQ(guess->score_per_echo, 150.0);
  EXPECT_EQ(results[1].beams_echo, 20);
}

TEST(Answers, LeadNowhereFromAfarOrWithoutOdometryOrHypotheses) {
  std::vector<Scan> scans(6, at_odometry({}));
  std::vector<SearchResult> results(scans.size());
  const auto guess_after = [&](const SearchResult& first, std::size_t scan) {
    Answers answers(scans, results);
    answers.give(0, first);
    return answers.guess(scan).has_value();
  };
  EXPECT_TRUE(guess_after(found_at({}), 4));
  EXPECT_FALSE(guess_after(found_at({}), 5));
  EXPECT_FALSE(guess_after(SearchResult{}, 1));
  scans[1].T_odom_robot.reset();
  EXPECT_FALSE(guess_after(found_at({}), 1));
  scans[0].T_odom_robot = Pose2{-1.7e308, 0.0, 0.0};
  EXPECT_FALSE(guess_after(found_at({1.7e308, 0.0, 0.0}), 2));
}

// The same scan over and over: the robot stood still, was turned, carried away, or odometry is nonsense.
TEST(Answers, DoNotDependOnGuesses) {
  const Pose2 T_odom_robot[] = {
      {}, {}, {0.3, -0.2, 0.1}, {0.0, 0.0, 3.0}, {40.0, -7.0, 1.0}, {1e12, 1e300, 0.0}, {1e12, 1e300, 0.0}};
  std::int64_t bounds_alone = 0;
  std::int64_t bounds_where_it_stood = 0;
  for (std::uint64_t seed = 3000; seed < 3060 && !::testing::Test::HasFailure(); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    testing::World world = testing::large_world(seed);
    world.options.threads = 1;
    const SearchResult alone = testing::answer_or_error(world.map, world.prior, world.scan, world.options);
    if (alone.hypotheses.empty()) continue;
    std::vector<Scan> scans;
    for (const Pose2& pose : T_odom_robot) {
      scans.push_back(world.scan);
      scans.back().T_odom_robot = pose;
    }
    for (const int threads : {1, 2}) {
      world.options.threads = threads;
      const std::vector<SearchResult> batch = search(world.map, world.prior, scans, world.options);
      for (const SearchResult& result : batch) testing::expect_same_answer(result, alone);
      if (threads == 1) {
        bounds_alone += alone.counts.bounds_computed;
        bounds_where_it_stood += batch[1].counts.bounds_computed;
      }
    }
  }
  EXPECT_GT(bounds_alone, 1'000'000);
  EXPECT_LT(bounds_where_it_stood, bounds_alone);
}

}  // namespace
}  // namespace landfall
