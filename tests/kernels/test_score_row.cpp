#include "kernels/score_row.hpp"

#include <gtest/gtest.h>

#include "instruction_sets.hpp"
#include "random_field.hpp"

namespace landfall {
namespace {

using Scores = std::vector<std::int32_t>;

TEST(ScoreRow, AddsTheFieldUnderEachPoint) {
  const std::vector<std::uint8_t> field{1,  2,  3,  //
                                        10, 20, 30};
  const Scores col{0, 1, -1, 0};
  const Scores row{1, 0, 0, 5};  // the last one is off the map from every row
  Scores scores{100, 100, 100};
  std::vector<std::uint16_t> partial(3);
  kernels::score_row(field.data(), 3, 2, 0, col.data(), row.data(), 4, partial.data(), scores.data());
  EXPECT_EQ(scores, (Scores{100 + 10 + 2, 100 + 20 + 3 + 1, 100 + 30 + 2}));
}

TEST(ScoreRow, EqualsItsTwinOnEveryInstructionSet) {
  testing::RandomField random(2);
  for (const std::string& name : testing::instruction_sets()) {
    SCOPED_TRACE(name);
    const testing::UsedInstructionSet used(name);
    for (const int points : testing::point_counts) {
      for (const int width : {1, 7, 31, 32, 33, 65, 130}) {
        const int height = random.between(1, 20);
        const auto field = random.bytes(testing::area(width, height));
        const Scores col = random.integers(static_cast<std::size_t>(points), -width - 2, width + 2);
        const Scores row = random.integers(static_cast<std::size_t>(points), -height - 2, height + 2);
        const int at = random.between(0, height - 1);
        std::vector<std::uint16_t> partial(static_cast<std::size_t>(width), 77);
        Scores scores = random.integers(static_cast<std::size_t>(width), 0, 1'000'000);
        Scores expected = scores;
        kernels::score_row(field.data(), width, height, at, col.data(), row.data(), col.size(),
                           partial.data(), scores.data());
        kernels::scalar::score_row(field.data(), width, height, at, col.data(), row.data(), col.size(),
                                   partial.data(), expected.data());
        EXPECT_EQ(scores, expected) << points << " points, width " << width;
      }
    }
  }
}

TEST(ScoreRow, SumsBeyondSixteenBits) {
  const std::vector<std::uint8_t> field(40, 255);
  const Scores zero(1000, 0);
  for (const std::string& name : testing::instruction_sets()) {
    const testing::UsedInstructionSet used(name);
    Scores scores(40);
    std::vector<std::uint16_t> partial(40);
    kernels::score_row(field.data(), 40, 1, 0, zero.data(), zero.data(), zero.size(), partial.data(),
                       scores.data());
    EXPECT_EQ(scores, Scores(40, 255'000)) << name;
  }
}

}  // namespace
}  // namespace landfall
