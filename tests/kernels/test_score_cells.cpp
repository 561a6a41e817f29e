#include "kernels/score_cells.hpp"

#include <gtest/gtest.h>

#include "instruction_sets.hpp"
#include "random_field.hpp"

namespace landfall {
namespace {

using Numbers = std::vector<std::int32_t>;

Numbers scored(const std::vector<std::int8_t>& global, std::size_t at, const Numbers& offset,
               const Numbers& run_end, const Numbers& run_weight, std::size_t cols) {
  Numbers scores(kernels::whole_columns(cols), 12345);
  kernels::score_cells(global.data() + at,
                       {.offset = offset.data(),
                        .run_end = run_end.data(),
                        .run_weight = run_weight.data(),
                        .runs = run_end.size()},
                       cols, scores.data());
  scores.resize(cols);
  return scores;
}

TEST(ScoreCells, WeighsTheCellsUnderTheLocalGrid) {
  std::vector<std::int8_t> global(100, 0);
  global[0] = 1;
  global[1] = -1;
  global[2] = 1;
  // Two cells of weight 10 beside each other, and one of weight -3 two columns on.
  EXPECT_EQ(scored(global, 0, {0, 1, 2}, {2, 3}, {10, -3}, 3), (Numbers{0 - 3, 0, 10}));
}

TEST(ScoreCells, EqualsItsTwinOnEveryInstructionSet) {
  testing::RandomField random(3);
  for (const std::string& name : testing::instruction_sets()) {
    SCOPED_TRACE(name);
    const testing::UsedInstructionSet used(name);
    for (const std::size_t cols : {1, 15, 16, 17, 31, 33, 63, 64, 65, 130}) {
      constexpr int reach = 500;
      std::vector<std::int8_t> global(2 * reach + kernels::whole_columns(cols));
      for (std::int8_t& cell : global) cell = static_cast<std::int8_t>(random.between(-1, 1));
      Numbers offset, run_end, run_weight;
      for (int run = random.between(0, 9); run >= 0; --run) {
        const int cells = random.between(0, 3) == 0 ? random.between(100, 400) : random.between(0, 9);
        const Numbers more = random.integers(static_cast<std::size_t>(cells), -reach, reach);
        offset.insert(offset.end(), more.begin(), more.end());
        run_end.push_back(static_cast<std::int32_t>(offset.size()));
        run_weight.push_back(random.between(-100'000, 100'000));
      }
      Numbers expected(kernels::whole_columns(cols));
      kernels::scalar::score_cells(global.data() + reach,
                                   {.offset = offset.data(),
                                    .run_end = run_end.data(),
                                    .run_weight = run_weight.data(),
                                    .runs = run_end.size()},
                                   cols, expected.data());
      expected.resize(cols);
      EXPECT_EQ(scored(global, reach, offset, run_end, run_weight, cols), expected) << cols << " columns";
    }
  }
}

TEST(ScoreCells, SumsBeyondABytesRange) {
  const std::vector<std::int8_t> ones(400, 1);
  const std::vector<std::int8_t> minus_ones(400, -1);
  const Numbers zero(1000, 0);
  for (const std::string& name : testing::instruction_sets()) {
    const testing::UsedInstructionSet used(name);
    EXPECT_EQ(scored(ones, 0, zero, {1000}, {7}, 70), Numbers(70, 7000)) << name;
    EXPECT_EQ(scored(minus_ones, 0, zero, {1000}, {7}, 70), Numbers(70, -7000)) << name;
  }
}

}  // namespace
}  // namespace landfall
