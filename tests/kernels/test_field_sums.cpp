#include "kernels/field_sums.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "instruction_sets.hpp"
#include "random_field.hpp"

namespace landfall {
namespace {

using kernels::FieldPose;
using kernels::FieldSums;
using kernels::FieldView;

std::array<double, 11> numbers(const FieldSums& sums) {
  return {sums.cost, sums.field, sums.h_xx, sums.h_xy, sums.h_xt, sums.h_yy,
          sums.h_yt, sums.h_tt,  sums.g_x,  sums.g_y,  sums.g_t};
}

// A random field, kept to the byte so that reading past it is seen, and points around it and beyond.
struct Cloud {
  std::int32_t width, height;
  std::vector<std::uint8_t> values;
  std::vector<double> x_cells, y_cells;
  FieldPose pose;

  Cloud(testing::RandomField& random, int points)
      : width(random.between(1, random.between(1, 40))),
        height(random.between(1, random.between(1, 40))),
        values(random.bytes(testing::area(width, height))) {
    const auto real = [&](int low, int high) { return random.between(100 * low, 100 * high) / 100.0; };
    for (int i = 0; i < points; ++i) {
      x_cells.push_back(real(-width, width));
      y_cells.push_back(real(-height, height));
    }
    const double theta_rad = real(-3, 3);
    pose = {.x_cells = real(0, width),
            .y_cells = real(0, height),
            .cos_theta = std::cos(theta_rad),
            .sin_theta = std::sin(theta_rad)};
  }
  [[nodiscard]] FieldView field() const { return {values.data(), width, height}; }
  template <class Kernel>
  [[nodiscard]] FieldSums run(const Kernel& kernel) const {
    return kernel(field(), pose, x_cells.data(), y_cells.data(), x_cells.size());
  }
};

class FieldSumsOnSets : public ::testing::TestWithParam<std::string> {
 protected:
  testing::UsedInstructionSet used_{GetParam()};
  testing::RandomField random_{11};

  template <class Kernel, class Twin>
  void expect_equal(const Kernel& kernel, const Twin& twin) {
    for (const int points : testing::point_counts)
      for (int repeat = 0; repeat < 8; ++repeat) {
        const Cloud cloud(random_, points);
        ASSERT_EQ(numbers(cloud.run(kernel)), numbers(cloud.run(twin))) << points;
      }
  }
};

TEST_P(FieldSumsOnSets, LackEqualsItsTwin) {
  expect_equal(kernels::sum_lack, kernels::scalar::sum_lack);
}

TEST_P(FieldSumsOnSets, RootEqualsItsTwin) {
  expect_equal(kernels::sum_root, kernels::scalar::sum_root);
}

INSTANTIATE_TEST_SUITE_P(InstructionSets, FieldSumsOnSets, ::testing::ValuesIn(testing::instruction_sets()),
                         [](const auto& set) { return set.param; });

// Half way between four cells of a 2 x 2 field.
TEST(FieldSumsByHand, BilinearBetweenTheCentres) {
  const std::vector<std::uint8_t> values{0, 51, 102, 255};
  const double origin = 0.0;
  const FieldSums sums =
      kernels::scalar::sum_lack({values.data(), 2, 2}, {.x_cells = 1.0, .y_cells = 1.0}, &origin, &origin, 1);
  EXPECT_NEAR(sums.field, 0.4, 1e-12);
  EXPECT_NEAR(sums.cost, 0.36, 1e-12);
  EXPECT_NEAR(sums.h_xx, 0.16, 1e-12);  // d_col = ((0.2 - 0) + (1 - 0.4)) / 2
  EXPECT_NEAR(sums.h_yy, 0.36, 1e-12);  // d_row = ((0.4 - 0) + (1 - 0.2)) / 2
  EXPECT_NEAR(sums.g_y, 0.6 * 0.6, 1e-12);
  EXPECT_EQ(sums.h_tt, 0.0);
}

// The derivatives against differences of the cost: d cost = -2 g for residuals 1 - v, -2 g for their roots.
TEST(FieldSumsByHand, GradientIsTheCostsSlope) {
  testing::RandomField random(12);
  for (int repeat = 0; repeat < 50; ++repeat) {
    Cloud cloud(random, 1);
    cloud.x_cells.front() = 0.0;
    cloud.y_cells.front() = 0.0;
    constexpr double step = 1e-6;
    const FieldSums here = cloud.run(kernels::scalar::sum_lack);
    cloud.pose.x_cells += step;
    const FieldSums there = cloud.run(kernels::scalar::sum_lack);
    if (std::floor(cloud.pose.x_cells - 0.5) != std::floor(cloud.pose.x_cells - step - 0.5)) continue;
    EXPECT_NEAR((there.cost - here.cost) / step, -2.0 * here.g_x, 1e-4);
  }
}

}  // namespace
}  // namespace landfall
