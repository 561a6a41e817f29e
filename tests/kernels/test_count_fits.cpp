#include "kernels/count_fits.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "instruction_sets.hpp"
#include "random_field.hpp"

namespace landfall {
namespace {

// 64 x 3 cells; (3, 1) and (40, 1) are marked.
const std::vector<std::uint32_t> words{0, 0, 1U << 3, 1U << 8, 0, 0};
const kernels::CellBits cells{words.data(), 2, 64, 3};

TEST(CountFits, CountsPointsInMarkedCells) {
  const std::vector<float> x{0.0f, 0.9f, -0.1f, 37.5f, 1.0f, 0.5f};
  const std::vector<float> y{0.0f, 0.9f, 0.0f, 0.5f, 0.0f, 1.0f};
  // From (3, 1): in, in, column 2, (40.5, 1.5) in, column 4, row 2.
  EXPECT_EQ(kernels::count_fits(cells, {3.0f, 1.0f, 1.0f, 0.0f}, x.data(), y.data(), x.size()), 3);
  // A quarter turn left takes (37.5, 0) up and off the grid: the border is not marked.
  EXPECT_EQ(kernels::count_fits(cells, {3.5f, 1.5f, 0.0f, 1.0f}, x.data() + 3, y.data(), 1), 0);
}

TEST(CountFits, WhatLiesBeyondCountsAsLyingOnTheBorder) {
  const std::vector<float> x{-1e9f, 1e9f, 0.0f, 0.0f};
  const std::vector<float> y{0.0f, 0.0f, -1e9f, 1e9f};
  EXPECT_EQ(kernels::count_fits(cells, {3.5f, 1.5f, 1.0f, 0.0f}, x.data(), y.data(), x.size()), 0);
}

TEST(CountFits, EqualsItsTwinOnEveryInstructionSet) {
  testing::RandomField random(3);
  for (const std::string& name : testing::instruction_sets()) {
    SCOPED_TRACE(name);
    const testing::UsedInstructionSet used(name);
    for (const int points : testing::point_counts) {
      const int row_words = random.between(1, 5);
      const int height = random.between(1, 90);
      std::vector<std::uint32_t> bits(static_cast<std::size_t>(row_words * height));
      for (std::uint32_t& word : bits) word = static_cast<std::uint32_t>(random.between(0, 1 << 30)) * 5U;
      const kernels::CellBits grid{bits.data(), row_words, row_words * 32, height};
      std::vector<float> x(static_cast<std::size_t>(points));
      std::vector<float> y(x.size());
      for (std::size_t i = 0; i < x.size(); ++i) {
        // Many exactly on a border between cells, where a fused multiply-add would tell.
        x[i] = i % 3 == 0 ? static_cast<float>(random.between(-90, 90))
                          : static_cast<float>(random.uniform(-200.0, 200.0));
        y[i] = i % 3 == 0 ? static_cast<float>(random.between(-90, 90))
                          : static_cast<float>(random.uniform(-200.0, 200.0));
      }
      const double theta = random.uniform(-3.0, 3.0);
      const kernels::PointPose pose{static_cast<float>(random.uniform(0.0, 90.0)),
                                    static_cast<float>(random.uniform(0.0, 90.0)),
                                    static_cast<float>(std::cos(theta)), static_cast<float>(std::sin(theta))};
      EXPECT_EQ(kernels::count_fits(grid, pose, x.data(), y.data(), x.size()),
                kernels::scalar::count_fits(grid, pose, x.data(), y.data(), x.size()))
          << points;
    }
  }
}

}  // namespace
}  // namespace landfall
