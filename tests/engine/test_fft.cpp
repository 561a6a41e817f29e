// Method fft, both its ways, against its oracle, exhaustive: the same candidates on any map, scan, prior.
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <numbers>
#include <thread>

#include "engine/maps/prepared_state.hpp"
#include "engine/methods/fft/correlation_search.hpp"
#include "engine/methods/table.hpp"
#include "random_world.hpp"
#include "rooms.hpp"
#include "same_answer.hpp"

namespace landfall {
namespace {

using internal::Clock;
using internal::Proposal;
using internal::Query;
using testing::World;

// A world as a method sees it.
struct Question {
  const World& world;
  internal::Lattice lattice = internal::make_lattice(world.map.grid(), world.options.translation_step_m,
                                                     world.options.rotation_step_rad);
  internal::EndPoints points = internal::make_end_points(world.scan, lattice.resolution_m);
  internal::Domain domain = internal::make_domain(
      world.prior, lattice, world.map.state().free_mask(world.options.robot_radius_m, lattice.step_cells));

  [[nodiscard]] Query query(int threads) const {
    return {.map = world.map.state(),
            .scan = world.scan,
            .points = points,
            .lattice = lattice,
            .domain = domain,
            .options = world.options,
            .margin = internal::rival_margin(points.size()),
            .threads = threads,
            .deadline = {}};
  }
  [[nodiscard]] bool has_poses() const { return domain.poses > 0 && points.size() > 0; }
};

void expect_same_candidates(const Proposal& actual, const Proposal& expected) {
  EXPECT_EQ(actual.proven, expected.proven);
  ASSERT_EQ(actual.candidates.size(), expected.candidates.size());
  for (std::size_t i = 0; i < actual.candidates.size(); ++i) {
    SCOPED_TRACE("candidate " + std::to_string(i));
    ASSERT_EQ(actual.candidates[i].score, expected.candidates[i].score);
    ASSERT_EQ(actual.candidates[i].pose, expected.candidates[i].pose);
  }
}

template <class MakeWorld>
void expect_equal_to_exhaustive(const MakeWorld& make_world, int cases) {
  int with_answer = 0;
  int asked = 0;
  for (std::uint64_t seed = 0; asked < cases && !::testing::Test::HasFailure(); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const World world = make_world(seed);
    const Question question{.world = world};
    if (!question.has_poses()) continue;
    const int threads = seed % 2 == 0 ? 1 : 2;
    const Proposal expected = internal::propose_exhaustive(question.query(1));
    expect_same_candidates(internal::propose_by_transforms(question.query(threads)), expected);
    expect_same_candidates(internal::propose_directly(question.query(threads)), expected);
    ++asked;
    with_answer += expected.candidates.empty() ? 0 : 1;
  }
  EXPECT_GT(with_answer, cases / 2);
}

TEST(Fft, EqualsExhaustiveInSmallWorlds) {
  expect_equal_to_exhaustive(testing::small_world, 120);
}

TEST(Fft, EqualsExhaustiveInLargeWorlds) {
  expect_equal_to_exhaustive(testing::large_world, 12);
}

TEST(Fft, EqualsExhaustiveWithFewBeamsAndCoarseHeadings) {
  expect_equal_to_exhaustive(testing::coarse_world, 8);
}

TEST(Fft, AnswersAsTheOthersDoAndSaysItsWay) {
  for (std::uint64_t seed = 5000; seed < 5060; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    World world = testing::small_world(seed);
    world.options.method = "exhaustive";
    const SearchResult expected = testing::answer_or_error(world.map, world.prior, world.scan, world.options);
    world.options.method = "fft";
    const SearchResult actual = testing::answer_or_error(world.map, world.prior, world.scan, world.options);
    testing::expect_same_answer(actual, expected);
    if (actual.counts.poses_scored + actual.counts.bounds_computed == 0) continue;
    const auto says = [&](const char* way) { return actual.method.find(way) != std::string::npos; };
    EXPECT_TRUE(says(", direct)") || says(", fftw ") || says(", eigen ")) << actual.method;
  }
}

Scan scan_of(int beams) {
  const PreparedMap map(testing::furnished_room());
  return testing::look(map, testing::full_circle(beams), {3.0, 2.0, 0.3});
}

TEST(Fft, TakesTransformsWherePointsAreMany) {
  World world{.map = PreparedMap(testing::furnished_room()),
              .prior = {Anywhere{}},
              .scan = scan_of(20'000),
              .options = {}};
  EXPECT_EQ(internal::choose_way(Question{.world = world}.query(1)), internal::CorrelationWay::transforms);
  world.scan = scan_of(30);
  EXPECT_EQ(internal::choose_way(Question{.world = world}.query(1)), internal::CorrelationWay::direct);
}

TEST(Fft, IsCutShortByTheTimeBudget) {
  const World world{.map = PreparedMap(testing::furnished_room()),
                    .prior = {Anywhere{}},
                    .scan = scan_of(1000),
                    .options = {}};
  const Question question{.world = world};
  Query query = question.query(1);
  query.deadline = Clock::now();
  const Proposal by_transforms = internal::propose_by_transforms(query);
  EXPECT_FALSE(by_transforms.proven);
  EXPECT_EQ(by_transforms.counts.bounds_computed, 0);
  EXPECT_FALSE(internal::propose_directly(query).proven);
}

TEST(Fft, PreparesSpectraOncePerReach) {
  const PreparedMap map(testing::furnished_room());  // 80 x 60 cells
  const auto near = map.state().field_spectra(3);
  EXPECT_EQ(map.state().field_spectra(10), near);
  const std::size_t bytes = map.memory_bytes();
  EXPECT_GE(bytes, near->memory_bytes());
  const auto far = map.state().field_spectra(500);
  EXPECT_NE(far, near);
  EXPECT_EQ(map.state().field_spectra(41), far);
  EXPECT_GE(far->fft().cols(), 160);
}

TEST(Fft, PlansFromManyThreads) {
  const World world{.map = PreparedMap(testing::furnished_room()),
                    .prior = {Anywhere{}},
                    .scan = scan_of(100),
                    .options = {.rotation_step_rad = 0.5}};
  const Question question{.world = world};
  const Proposal expected = internal::propose_exhaustive(question.query(1));
  std::vector<std::thread> threads;
  threads.reserve(8);
  for (int i = 0; i < 8; ++i)
    threads.emplace_back([&, i] {
      GridMap wider = world.map.grid();
      wider.width_cells += i % 4;  // each size is planned by two threads at once
      wider.cells.resize(static_cast<std::size_t>(wider.width_cells) * 60, Occupancy::free);
      const PreparedMap other(wider);
      (void)other.state().field_spectra(40 + i);
      expect_same_candidates(internal::propose_by_transforms(question.query(1)), expected);
    });
  for (std::thread& thread : threads) thread.join();
}

}  // namespace
}  // namespace landfall
