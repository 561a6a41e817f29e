// How far below the best score rivals are looked for, against the likelihood that says why.
#include "engine/evidence.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace landfall::internal {
namespace {

constexpr double least_likelihood_nats = 6.5;  // one in 665

std::int32_t perfect_score(std::size_t points) {
  return 255 * static_cast<std::int32_t>(points);
}

// What a pose of score `best - less` is behind the best one.
double nats_behind(std::int32_t best, std::int32_t less, std::size_t points) {
  return log_evidence(share_of(best, points), points) - log_evidence(share_of(best - less, points), points);
}

// calls test(points, best score, margin) from a score of 0 to a perfect one.
template <typename Test>
void at_many_scores(const Test& test) {
  for (const std::size_t points : {1U, 2U, 7U, 24U, 60U, 180U, 361U, 1440U, 4000U}) {
    SCOPED_TRACE(std::to_string(points) + " points");
    const RivalMargin margin = rival_margin(points);
    const std::int32_t perfect = perfect_score(points);
    const std::int32_t step = std::max(1, perfect / 997);
    for (std::int32_t best = 0; best < perfect; best += step) test(points, best, margin);
    test(points, perfect, margin);
  }
}

TEST(RivalMargin, NoRivalIsLessLikelyThanAsked) {
  at_many_scores([](std::size_t points, std::int32_t best, const RivalMargin& margin) {
    EXPECT_LE(nats_behind(best, margin.at(best), points), least_likelihood_nats + 1e-9) << "best " << best;
  });
}

// Up to the one count that scores are whole numbers for: a step farther would be less likely than asked.
TEST(RivalMargin, EveryRivalAsLikelyAsAskedIsWithinIt) {
  int reached = 0;
  at_many_scores([&](std::size_t points, std::int32_t best, const RivalMargin& margin) {
    if (margin.at(best) >= std::floor(margin.most_score)) return;  // bound by the fixed amount
    ++reached;
    EXPECT_GT(nats_behind(best, margin.at(best) + 1, points), least_likelihood_nats - 1e-9)
        << "best " << best;
  });
  EXPECT_GT(reached, 500);
}

// A share of 0.22 over the fourth root of the points.
TEST(RivalMargin, IsAtMostAFixedShare) {
  int bound = 0;
  at_many_scores([&](std::size_t points, std::int32_t best, const RivalMargin& margin) {
    const double most_share = 0.22 / std::pow(static_cast<double>(points), 0.25);
    const auto most = static_cast<std::int32_t>(most_share * perfect_score(points));
    EXPECT_LE(margin.at(best), most) << "best " << best;
    bound += margin.at(best) == most ? 1 : 0;
  });
  EXPECT_GT(bound, 1000);
}

// A better incumbent never brings back what a worse one had ruled out.
TEST(RivalMargin, TheLowestRivalRisesWithTheBest) {
  for (const std::size_t points : {1U, 7U, 180U, 1440U}) {
    for (const RivalMargin& margin : {rival_margin(points), second_margin(points)}) {
      std::int32_t last = -margin.at(0) - 1;
      for (std::int32_t best = 0; best <= perfect_score(points); ++best) {
        ASSERT_GT(best - margin.at(best), last) << points << " points, best " << best;
        last = best - margin.at(best);
      }
    }
  }
}

TEST(RivalMargin, ASecondLookTakesAQuarterOfAPerfectScore) {
  for (const std::int32_t best : {0, 1000, 255 * 180}) EXPECT_EQ(second_margin(180).at(best), 255 * 180 / 4);
}

TEST(RivalMargin, NoPointsHaveNone) {
  for (const RivalMargin& margin : {rival_margin(0), second_margin(0)}) EXPECT_EQ(margin.at(0), 0);
}

}  // namespace
}  // namespace landfall::internal
