#include "engine/rank/rank.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "rooms.hpp"

namespace landfall {
namespace {

using internal::Candidate;
using internal::Mode;
using internal::Modes;
using ::testing::HasSubstr;

constexpr std::size_t echoes = 100;
constexpr int perfect_score = 255 * static_cast<int>(echoes);

constexpr double room_m2 = 20.0;  // what the walls of a room hold

Mode mode_of(double share, double explained, double log_prior = 0.0, int map_index = 0) {
  Mode mode;
  mode.best.score = static_cast<std::int32_t>(share * perfect_score);
  mode.share = share;
  mode.log_prior = log_prior;
  mode.map_index = map_index;
  mode.verification = {
      .explained = explained, .blocked = 1.0 - explained, .seen_through = 0.0, .held_m2 = room_m2};
  mode.hypothesis.explained = explained;
  mode.hypothesis.score = mode.best.score;
  return mode;
}

Modes modes_of(std::vector<Mode> modes) {
  return {.modes = std::move(modes), .log_rest = -std::numeric_limits<double>::infinity(), .points = echoes};
}

SearchResult ranked(const std::vector<Modes>& maps, int max_hypotheses = 5, bool proven = true) {
  SearchResult result;
  result.proven = proven;
  internal::rank(maps, max_hypotheses, result);
  return result;
}

TEST(Rank, AGoodPoseWithoutRivalIsFound) {
  const SearchResult result = ranked({modes_of({mode_of(0.95, 0.98)})});
  EXPECT_EQ(result.verdict, Verdict::found);
  EXPECT_EQ(result.reason, "");
  EXPECT_GE(result.hypotheses.at(0).probability, 0.95);
  EXPECT_LT(result.hypotheses.at(0).probability, 1.0);
}

TEST(Rank, EqualRivalsShare) {
  const SearchResult result = ranked({modes_of({mode_of(0.99, 0.98), mode_of(0.99, 0.98)})});
  EXPECT_EQ(result.verdict, Verdict::ambiguous);
  EXPECT_EQ(result.reason, "");
  EXPECT_DOUBLE_EQ(result.hypotheses.at(0).probability, result.hypotheses.at(1).probability);
  EXPECT_NEAR(result.hypotheses.at(0).probability, 0.5, 0.03);
}

TEST(Rank, PriorsMultiplyTheLikelihood) {
  const SearchResult result = ranked({modes_of({mode_of(0.95, 0.98), mode_of(0.95, 0.98, std::log(7.0))})});
  EXPECT_NEAR(result.hypotheses.at(0).probability / result.hypotheses.at(1).probability, 7.0, 1e-9);
}

TEST(Rank, ABetterScoreIsMoreProbable) {
  double last = 0.0;
  for (const double lead : {0.0, 0.01, 0.02, 0.05, 0.2}) {
    const SearchResult result = ranked({modes_of({mode_of(0.9, 0.95), mode_of(0.9 - lead, 0.95)})});
    EXPECT_GT(result.hypotheses.at(0).probability, last);
    last = result.hypotheses.at(0).probability;
  }
  EXPECT_GT(last, 0.95);
}

TEST(Rank, ABadFitTellsPosesApartLess) {
  const auto probability = [](double share) {
    return ranked({modes_of({mode_of(share, 0.9), mode_of(share - 0.03, 0.9)})}).hypotheses.at(0).probability;
  };
  EXPECT_GT(probability(0.95), probability(0.90));
  EXPECT_GT(probability(0.90), probability(0.80));
}

TEST(Rank, APoseFoundByChanceIsNotCalledFound) {
  EXPECT_EQ(ranked({modes_of({mode_of(0.85, 0.9)})}).verdict, Verdict::found);
  EXPECT_EQ(ranked({modes_of({mode_of(0.75, 0.9)})}).verdict, Verdict::ambiguous);
  EXPECT_EQ(ranked({modes_of({mode_of(0.85, 0.9), mode_of(0.82, 0.9)})}).verdict, Verdict::ambiguous);
}

// A wall of 6 m with 10 cm of something across, beside a room: of the same fit.
TEST(Rank, APoseThatLittleContourHoldsIsNotCalledFound) {
  Mode mode = mode_of(0.95, 0.98);
  EXPECT_EQ(ranked({modes_of({mode})}).verdict, Verdict::found);
  mode.verification.held_m2 = (6.0 + 0.2) * (0.1 + 0.2);
  const SearchResult corridor = ranked({modes_of({mode})});
  EXPECT_EQ(corridor.verdict, Verdict::ambiguous);
  EXPECT_GT(corridor.hypotheses.at(0).probability, 0.5);
}

TEST(Rank, ARivalThatExplainsMoreBeamsShakesTheBest) {
  const auto probability = [](double rival_explained) {
    const SearchResult result = ranked({modes_of({mode_of(0.95, 0.85), mode_of(0.91, rival_explained)})});
    EXPECT_NEAR(result.hypotheses.at(0).explained, 0.85, 1e-12);
    EXPECT_GE(result.hypotheses.at(0).probability, result.hypotheses.at(1).probability);
    return result.hypotheses.at(0).probability;
  };
  EXPECT_GT(probability(0.85), probability(0.90));
  EXPECT_GT(probability(0.90), probability(0.95));
}

TEST(Rank, MapsAreRankedTogether) {
  const SearchResult result = ranked({modes_of({mode_of(0.90, 0.95, 0.0, 0), mode_of(0.86, 0.95, 0.0, 0)}),
                                      modes_of({mode_of(0.92, 0.95, 0.0, 1), mode_of(0.88, 0.95, 0.0, 1)})});
  ASSERT_EQ(result.hypotheses.size(), 4u);
  const std::vector<int> order{result.hypotheses[0].map_index, result.hypotheses[1].map_index,
                               result.hypotheses[2].map_index, result.hypotheses[3].map_index};
  EXPECT_EQ(order, (std::vector<int>{1, 0, 1, 0}));
}

TEST(Rank, WhatIsCutOffStillWeighs) {
  const std::vector<Modes> maps{modes_of({mode_of(0.95, 0.98), mode_of(0.95, 0.98), mode_of(0.95, 0.98)})};
  const SearchResult one = ranked(maps, 1);
  ASSERT_EQ(one.hypotheses.size(), 1u);
  EXPECT_DOUBLE_EQ(one.hypotheses[0].probability, ranked(maps, 3).hypotheses.at(0).probability);
  EXPECT_EQ(one.verdict, Verdict::ambiguous);
}

TEST(Rank, LessThanHalfExplainedIsLost) {
  const SearchResult result = ranked({modes_of({mode_of(0.95, 0.49)})});
  EXPECT_EQ(result.verdict, Verdict::lost);
  EXPECT_THAT(result.reason, HasSubstr("half of the beams"));
  EXPECT_EQ(result.hypotheses.size(), 1u);
  EXPECT_NE(ranked({modes_of({mode_of(0.95, 0.5)})}).verdict, Verdict::lost);
}

TEST(Rank, NoCandidateIsLost) {
  const SearchResult result = ranked({modes_of({})});
  EXPECT_EQ(result.verdict, Verdict::lost);
  EXPECT_THAT(result.reason, HasSubstr("no echo"));
  EXPECT_THAT(ranked({modes_of({})}, 5, false).reason, HasSubstr("time budget"));
}

// Candidates on a lattice of 10 cm and 0.1 rad, best first, all of score 1000 less their place in the list.
struct FindModes : ::testing::Test {
  const PreparedMap map{testing::empty_room(100, 100, 0.1)};
  const Scan scan = testing::look(map, testing::full_circle(8), {5.05, 5.05, 0.0});
  const internal::EndPoints points = internal::make_end_points(scan, 0.1);
  const internal::Lattice lattice = internal::make_lattice(map.grid(), 0.0, 0.1);
  const internal::Domain domain = internal::make_domain({Anywhere{}}, lattice, map.state().free_mask(0.0, 1));
  const SearchOptions options{.distinct_translation_m = 0.5, .distinct_rotation_rad = 0.25};
  const internal::Query query{.map = map.state(),
                              .scan = scan,
                              .points = points,
                              .lattice = lattice,
                              .domain = domain,
                              .options = options,
                              .threads = 1,
                              .deadline = {}};

  [[nodiscard]] Modes find(const std::vector<internal::LatticePose>& poses, std::size_t most = 10) const {
    std::vector<Candidate> candidates(poses.size());
    for (std::size_t i = 0; i < poses.size(); ++i)
      candidates[i] = {.pose = poses[i], .score = 1000 - static_cast<std::int32_t>(i)};
    return internal::find_modes(query, candidates, most);
  }
};

TEST_F(FindModes, PosesNearerThanBothDistancesAreOne) {
  const Modes found = find({{.heading = 10, .row = 50, .col = 50},   //
                            {.heading = 11, .row = 52, .col = 54},   // 0.447 m, 0.1 rad: the first one
                            {.heading = 10, .row = 50, .col = 56},   // 0.6 m away
                            {.heading = 13, .row = 50, .col = 50},   // 0.3 rad away
                            {.heading = 8, .row = 50, .col = 47}});  // 0.3 m, 0.2 rad: the first one
  ASSERT_EQ(found.modes.size(), 3u);
  EXPECT_EQ(found.modes[0].best.score, 1000);
  EXPECT_EQ(found.modes[1].best.score, 998);
  EXPECT_EQ(found.modes[2].best.score, 997);
}

TEST_F(FindModes, HeadingsWrap) {
  EXPECT_EQ(
      find({{.heading = 0, .row = 50, .col = 50}, {.heading = lattice.headings - 1, .row = 50, .col = 50}})
          .modes.size(),
      1u);
}

TEST_F(FindModes, ModesBeyondTheLastWeigh) {
  const std::vector<internal::LatticePose> three{{.heading = 0, .row = 10, .col = 10},
                                                 {.heading = 0, .row = 50, .col = 50},
                                                 {.heading = 0, .row = 90, .col = 90}};
  EXPECT_TRUE(std::isinf(find(three, 3).log_rest));
  const Modes two = find(three, 2);
  EXPECT_EQ(two.modes.size(), 2u);
  EXPECT_TRUE(std::isfinite(two.log_rest));
}

}  // namespace
}  // namespace landfall
