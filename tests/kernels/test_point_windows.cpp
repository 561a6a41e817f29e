#include "kernels/point_windows.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "instruction_sets.hpp"
#include "random_field.hpp"

namespace landfall {
namespace {

using Integers = std::vector<std::int32_t>;

struct Windows {
  Integers col_half, row_half, size_halves;
  friend bool operator==(const Windows&, const Windows&) = default;
};

struct Question {
  std::vector<double> x, y;
  double center_rad = 0.0;
  double half_rad = 0.0;
  kernels::WindowGrid grid{.width_cells = 400, .height_cells = 300, .block_cells = 8};

  [[nodiscard]] kernels::Turn turn() const {
    return {.cos_center = std::cos(center_rad),
            .sin_center = std::sin(center_rad),
            .sin_half = half_rad >= std::numbers::pi / 2 ? 1.0 : std::sin(half_rad),
            .cos_half = std::cos(half_rad)};
  }
  template <class Kernel>
  [[nodiscard]] Windows ask(const Kernel& kernel) const {
    Windows windows{Integers(x.size()), Integers(x.size()), Integers(x.size())};
    kernel(x.data(), y.data(), x.size(), turn(), grid, windows.col_half.data(), windows.row_half.data(),
           windows.size_halves.data());
    return windows;
  }
};

Question random_question(testing::RandomField& random, int points) {
  Question question;
  for (int i = 0; i < points; ++i) {
    question.x.push_back(random.uniform(-500.0, 500.0));
    question.y.push_back(random.uniform(-500.0, 500.0));
  }
  question.center_rad = random.uniform(-4.0, 4.0);
  question.half_rad = random.between(0, 3) == 0 ? 0.0 : random.uniform(0.0, 2.0);
  question.grid.block_cells = 8 << random.between(0, 2);
  return question;
}

// Whatever heading of the group and cell of the block the robot stands at, the point lies in its window.
TEST(PointWindows, HoldEveryPlaceOfThePoint) {
  testing::RandomField random(7);
  for (int repeat = 0; repeat < 50; ++repeat) {
    const Question question = random_question(random, 20);
    const Windows windows = question.ask(kernels::scalar::point_windows);
    const int half = question.grid.block_cells / 2;
    for (std::size_t i = 0; i < question.x.size(); ++i) {
      for (double part = -1.0; part <= 1.0; part += 0.125) {
        const double heading_rad = question.center_rad + part * question.half_rad;
        const double c = std::cos(heading_rad);
        const double s = std::sin(heading_rad);
        const auto col = static_cast<int>(std::floor(0.5 + c * question.x[i] - s * question.y[i]));
        const auto row = static_cast<int>(std::floor(0.5 + s * question.x[i] + c * question.y[i]));
        if (windows.size_halves[i] == 0) {
          // Off a map of this size from every cell of it.
          EXPECT_TRUE(std::abs(col) >= question.grid.width_cells ||
                      std::abs(row) >= question.grid.height_cells);
          continue;
        }
        for (const int cell : {0, question.grid.block_cells - 1}) {
          EXPECT_GE(col + cell, windows.col_half[i] * half);
          EXPECT_LT(col + cell, (windows.col_half[i] + windows.size_halves[i]) * half);
          EXPECT_GE(row + cell, windows.row_half[i] * half);
          EXPECT_LT(row + cell, (windows.row_half[i] + windows.size_halves[i]) * half);
        }
      }
    }
  }
}

// One heading: a block and the rounding of its offset to a half block.
TEST(PointWindows, AreNoWiderThanNeeded) {
  testing::RandomField random(8);
  Question question = random_question(random, 200);
  question.half_rad = 0.0;
  const Windows windows = question.ask(kernels::scalar::point_windows);
  for (const std::int32_t size : windows.size_halves) EXPECT_LE(size, 3);
}

TEST(PointWindows, EqualTheirTwinOnEveryInstructionSet) {
  for (const std::string& name : testing::instruction_sets()) {
    SCOPED_TRACE(name);
    const testing::UsedInstructionSet used(name);
    testing::RandomField random(9);
    for (const int points : testing::point_counts) {
      const Question question = random_question(random, points);
      EXPECT_EQ(question.ask(kernels::point_windows), question.ask(kernels::scalar::point_windows)) << points;
    }
  }
}

}  // namespace
}  // namespace landfall
