#include "kernels/score_block.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "engine/maps/search_tables.hpp"
#include "instruction_sets.hpp"
#include "random_field.hpp"

namespace landfall {
namespace {

using kernels::block_cells;
using kernels::block_poses;
using Integers = std::vector<std::int32_t>;
using Scores = std::array<std::int32_t, block_poses>;

// A random field with its planes, a block of poses on it, and points that reach beyond it.
struct Block {
  int width, height, col, row;
  std::vector<std::uint8_t> field;
  internal::WindowTables tables;
  Integers point_col, point_row;

  Block(testing::RandomField& random, int points)
      : width(random.between(1, 60)),
        height(random.between(1, 60)),
        col(block_cells * random.between(0, (width - 1) / block_cells)),
        row(block_cells * random.between(0, (height - 1) / block_cells)),
        field(random.bytes(testing::area(width, height))),
        tables(internal::make_window_tables(field, width, height)),
        point_col(random.integers(static_cast<std::size_t>(points), -width - 20, width + 20)),
        point_row(random.integers(static_cast<std::size_t>(points), -height - 20, height + 20)) {}

  template <class Kernel>
  bool run(const Kernel& kernel, std::int32_t threshold, Scores& scores) const {
    return kernel(tables.planes(), col, row, point_col.data(), point_row.data(), point_col.size(), threshold,
                  scores.data());
  }
  [[nodiscard]] std::int32_t field_at(int c, int r) const {
    if (c < 0 || c >= width || r < 0 || r >= height) return 0;
    return field.data()[r * width + c];
  }
  // Straight from the field.
  [[nodiscard]] Scores scores() const {
    Scores sums{};
    for (int lane = 0; lane < block_poses; ++lane)
      for (std::size_t i = 0; i < point_col.size(); ++i)
        sums[static_cast<std::size_t>(lane)] +=
            field_at(col + lane % block_cells + point_col[i], row + lane / block_cells + point_row[i]);
    return sums;
  }
};

class ScoreBlock : public ::testing::TestWithParam<std::string> {
 protected:
  testing::UsedInstructionSet used_{GetParam()};
  testing::RandomField random_{3};
};

TEST_P(ScoreBlock, ScoresEqualTheField) {
  for (const int points : testing::point_counts) {
    const Block block(random_, points);
    Scores scores{}, twin{};
    ASSERT_TRUE(block.run(kernels::score_block, 0, scores));
    ASSERT_TRUE(block.run(kernels::scalar::score_block, 0, twin));
    EXPECT_EQ(scores, block.scores()) << points;
    EXPECT_EQ(twin, block.scores()) << points;
  }
}

TEST_P(ScoreBlock, GivesUpOnlyWhereNoPoseReachesTheThreshold) {
  for (const int points : testing::point_counts) {
    const Block block(random_, points);
    const Scores expected = block.scores();
    const std::int32_t largest = *std::max_element(expected.begin(), expected.end());
    for (const std::int32_t threshold : {1, largest / 2, largest - 1, largest}) {
      Scores scores{};
      ASSERT_TRUE(block.run(kernels::score_block, std::min(threshold, largest), scores));
      EXPECT_EQ(scores, expected) << points;
    }
    Scores scores{};
    for (const std::int32_t threshold : {largest + 1, 2 * largest + 1, 1 << 30})
      EXPECT_FALSE(block.run(kernels::score_block, threshold, scores)) << points;
  }
}

TEST_P(ScoreBlock, SumsBeyondSixteenBits) {
  const std::vector<std::uint8_t> field(100, 255);
  const internal::WindowTables tables = internal::make_window_tables(field, 10, 10);
  const Integers zero(1000, 0);
  Scores scores{}, expected{};
  expected.fill(255'000);
  ASSERT_TRUE(kernels::score_block(tables.planes(), 0, 0, zero.data(), zero.data(), zero.size(), 255'000,
                                   scores.data()));
  EXPECT_EQ(scores, expected);
}

INSTANTIATE_TEST_SUITE_P(InstructionSets, ScoreBlock, ::testing::ValuesIn(testing::instruction_sets()),
                         [](const auto& set) { return set.param; });

}  // namespace
}  // namespace landfall
