#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <vector>

#include "engine/base/counter_rng.hpp"

namespace landfall::internal {
namespace {

// Known answers of the Random123 distribution (kat_vectors, philox4x32 with 10 rounds).
TEST(Philox, GivesThePublishedAnswers) {
  EXPECT_EQ(philox4x32({0, 0, 0, 0}, {0, 0}),
            (PhiloxCounter{0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8}));
  EXPECT_EQ(philox4x32({~0u, ~0u, ~0u, ~0u}, {~0u, ~0u}),
            (PhiloxCounter{0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd}));
  EXPECT_EQ(philox4x32({0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344}, {0xa4093822, 0x299f31d0}),
            (PhiloxCounter{0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1}));
}

TEST(CounterRng, AStreamIsAFunctionOfItsKeys) {
  std::set<std::uint32_t> first;
  for (std::uint64_t seed : {std::uint64_t{0}, std::uint64_t{1}, std::uint64_t{1} << 32})
    for (std::uint32_t a : {0u, 1u})
      for (std::uint32_t b : {0u, 1u})
        for (std::uint32_t c : {0u, 1u}) {
          EXPECT_EQ(CounterRng(seed, a, b, c).bits(), CounterRng(seed, a, b, c).bits());
          first.insert(CounterRng(seed, a, b, c).bits());
        }
  EXPECT_EQ(first.size(), 24u);
}

TEST(CounterRng, UniformAndNormalHaveTheirMoments) {
  constexpr int draws = 200'000;
  CounterRng rng(42);
  double sum = 0.0, normal_sum = 0.0, normal_squares = 0.0;
  for (int i = 0; i < draws; ++i) {
    const double u = rng.uniform();
    ASSERT_GE(u, 0.0);
    ASSERT_LT(u, 1.0);
    sum += u;
    const double n = rng.normal();
    normal_sum += n;
    normal_squares += n * n;
  }
  // Within five standard errors.
  EXPECT_NEAR(sum / draws, 0.5, 5.0 * std::sqrt(1.0 / 12.0 / draws));
  EXPECT_NEAR(normal_sum / draws, 0.0, 5.0 / std::sqrt(draws));
  EXPECT_NEAR(normal_squares / draws, 1.0, 5.0 * std::sqrt(2.0 / draws));
}

TEST(CounterRng, BelowReachesAllOfItsValuesAlike) {
  constexpr int draws = 60'000;
  CounterRng rng(1, 2, 3);
  std::vector<int> count(6, 0);
  for (int i = 0; i < draws; ++i) ++count.at(rng.below(6));
  for (const int n : count) EXPECT_NEAR(n, draws / 6.0, 5.0 * std::sqrt(draws * 5.0 / 36.0));
}

}  // namespace
}  // namespace landfall::internal
