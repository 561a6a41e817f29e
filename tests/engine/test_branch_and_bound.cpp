// Branch and bound against its oracle, exhaustive: the same hypotheses on any map, scan, prior and step.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>

#include "instruction_sets.hpp"
#include "random_world.hpp"
#include "same_answer.hpp"

namespace landfall {
namespace {

using testing::answer_or_error;
using testing::expect_same_answer;
using testing::World;

SearchResult answer(const World& world, const char* method, int threads = 1) {
  SearchOptions options = world.options;
  options.method = method;
  options.threads = threads;
  return answer_or_error(world.map, world.prior, world.scan, options);
}

// More poses than this are not all scored block by block.
constexpr std::int64_t many_poses = 200'000;

struct Tally {
  int cases = 0;
  int with_answer = 0;
  int with_many_poses = 0;
};

// As many cases, or a tenth where LANDFALL_ISA forces an instruction set: ctest runs the suite once on each.
int cases(int all) {
  return std::getenv("LANDFALL_ISA") == nullptr ? all : all / 10;
}

// Seeds [0, count).
template <class MakeWorld>
Tally expect_equal_to_exhaustive(const MakeWorld& make_world, int count) {
  Tally tally;
  for (std::uint64_t seed = 0; tally.cases < count && !::testing::Test::HasFailure(); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const World world = make_world(seed);
    const SearchResult expected = answer(world, "exhaustive");
    const SearchResult actual = answer(world, "branch_and_bound", seed % 2 == 0 ? 1 : 2);
    expect_same_answer(actual, expected);
    EXPECT_EQ(expected.proven, expected.counts.poses_scored > 0);
    ++tally.cases;
    tally.with_answer += expected.hypotheses.empty() ? 0 : 1;
    tally.with_many_poses += expected.counts.poses_covered > many_poses ? 1 : 0;
  }
  return tally;
}

TEST(BranchAndBound, EqualsExhaustiveInSmallWorlds) {
  const Tally tally = expect_equal_to_exhaustive(testing::small_world, cases(800));
  EXPECT_EQ(tally.cases, cases(800));
  EXPECT_GT(tally.with_answer, cases(400));
}

TEST(BranchAndBound, EqualsExhaustiveInLargeWorlds) {
  const Tally tally = expect_equal_to_exhaustive(testing::large_world, cases(300));
  EXPECT_EQ(tally.cases, cases(300));
  EXPECT_GT(tally.with_answer, cases(150));
  EXPECT_GT(tally.with_many_poses, cases(150));
}

TEST(BranchAndBound, EqualsExhaustiveWithFewBeamsAndCoarseHeadings) {
  const Tally tally = expect_equal_to_exhaustive(testing::coarse_world, cases(100));
  EXPECT_EQ(tally.cases, cases(100));
  EXPECT_GT(tally.with_answer, cases(50));
  EXPECT_GT(tally.with_many_poses, cases(50));
}

// Thirty beams end in the robot's own cell, which is free; one ends 100 cells ahead, somewhere else at each
// of the eight headings. Only it can score, and where it does, the robot stands far from any wall.
TEST(BranchAndBound, KeepsPosesThatOnlyAFarBeamSpeaksFor) {
  GridMap grid{.width_cells = 300,
               .height_cells = 300,
               .resolution_m = 1.0,
               .T_map_grid = {},
               .cells = std::vector<Occupancy>(90'000)};
  for (int row = 0; row < 300; ++row) grid.cells[grid.index({290, row})] = Occupancy::occupied;
  const auto sensor =
      std::make_shared<const Sensor>(make_fan({.beams = 31, .step_rad = 0.0, .range_max_m = 1e3}));
  World world{.map = PreparedMap(grid), .prior = {Anywhere{}}, .scan = {.sensor = sensor}, .options = {}};
  world.scan.ranges_m.assign(31, 0.3F);
  world.scan.ranges_m[7] = 100.0F;
  world.options.rotation_step_rad = std::numbers::pi / 4;
  const SearchResult expected = answer(world, "exhaustive");
  ASSERT_FALSE(expected.hypotheses.empty());
  EXPECT_EQ(expected.hypotheses[0].score, 255);
  EXPECT_EQ(expected.hypotheses[0].T_map_robot_unrefined, (Pose2{190.5, 0.5, 0.0}));
  expect_same_answer(answer(world, "branch_and_bound"), expected);
}

// Echoes so far away that no end point is left; in a batch after a scan that has many, which leaves a guess.
TEST(BranchAndBound, BoundsNothingWithoutPoints) {
  World world = testing::large_world(2);
  std::vector<Scan> scans{world.scan};
  const auto far_sighted = std::make_shared<const Sensor>(make_fan({.beams = 8, .range_max_m = 1e9}));
  world.scan = {.sensor = far_sighted, .ranges_m = std::vector<float>(8, 4e8F)};
  world.prior = {Anywhere{}};
  const SearchResult expected = answer(world, "exhaustive");
  const SearchResult actual = answer(world, "branch_and_bound");
  EXPECT_GT(actual.counts.poses_covered, many_poses);
  EXPECT_TRUE(actual.hypotheses.empty());
  expect_same_answer(actual, expected);
  scans.push_back(world.scan);
  for (Scan& scan : scans) scan.T_odom_robot = Pose2{};
  world.options.threads = 1;
  const std::vector<SearchResult> batch = search(world.map, world.prior, scans, world.options);
  EXPECT_FALSE(batch[0].hypotheses.empty());
  expect_same_answer(batch[1], expected);
}

TEST(BranchAndBound, AnswersTheSameOnEveryInstructionSet) {
  for (std::uint64_t seed = 1000; seed < 1040; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const World world = seed % 4 == 0 ? testing::large_world(seed) : testing::small_world(seed);
    for (const char* method : {"exhaustive", "branch_and_bound"}) {
      if (seed % 4 == 0 && std::string(method) == "exhaustive") continue;  // the plain twin takes long
      const SearchResult best = answer(world, method);
      for (const std::string& name : testing::instruction_sets()) {
        SCOPED_TRACE(std::string(method) + " on " + name);
        const testing::UsedInstructionSet used(name);
        const SearchResult forced = answer(world, method);
        expect_same_answer(forced, best);
        EXPECT_EQ(kernels::isa_name(), name);  // after the search as before it
      }
    }
  }
}

TEST(BranchAndBound, AnswersTheSameOnAnyNumberOfThreads) {
  for (std::uint64_t seed = 2000; seed < 2020; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const World world = seed % 2 == 0 ? testing::large_world(seed) : testing::small_world(seed);
    for (const char* method : {"exhaustive", "branch_and_bound"}) {
      const SearchResult one = answer(world, method, 1);
      for (const int threads : {0, 2, 5}) expect_same_answer(answer(world, method, threads), one);
    }
  }
}

}  // namespace
}  // namespace landfall
