#include "kernels/end_points.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "instruction_sets.hpp"
#include "random_field.hpp"

namespace landfall {
namespace {

using Cells = std::vector<std::int32_t>;

// Half a cell and less: the robot's own cell; from +0.5 on, the next one; -0.5 belongs to the own cell.
TEST(EndPointCells, RoundsFromTheCentreOfTheRobotsCell) {
  const std::vector<double> x{0.0, 0.49, 0.5, -0.5, -0.51, 3.0};
  const std::vector<double> y{0.0, -0.49, 1.5, -1.5, -1.51, 0.0};
  Cells col(x.size()), row(x.size());
  kernels::end_point_cells(x.data(), y.data(), x.size(), 1.0, 0.0, col.data(), row.data());
  EXPECT_EQ(col, (Cells{0, 0, 1, 0, -1, 3}));
  EXPECT_EQ(row, (Cells{0, 0, 2, -1, -2, 0}));
  kernels::end_point_cells(x.data(), y.data(), x.size(), 0.0, 1.0, col.data(),
                           row.data());  // a quarter turn left
  EXPECT_EQ(col, (Cells{0, 0, -1, 2, 2, 0}));
  EXPECT_EQ(row, (Cells{0, 0, 1, 0, -1, 3}));
}

TEST(EndPointCells, EqualsItsTwinOnEveryInstructionSet) {
  testing::RandomField random(1);
  for (const std::string& name : testing::instruction_sets()) {
    SCOPED_TRACE(name);
    const testing::UsedInstructionSet used(name);
    for (const int points : testing::point_counts) {
      const auto count = static_cast<std::size_t>(points);
      const double reach = random.between(0, 1) == 0 ? 20.0 : 536'870'000.0;  // up to about 2^29
      std::vector<double> x(count), y(count);
      for (std::size_t i = 0; i < count; ++i) {
        // Many exactly on a border between cells, where a fused multiply-add would tell.
        x[i] = i % 3 == 0 ? random.between(-9, 9) + 0.5 : random.uniform(-reach, reach) / 2;
        y[i] = i % 3 == 0 ? random.between(-9, 9) + 0.5 : random.uniform(-reach, reach) / 2;
      }
      const double heading_rad =
          random.between(0, 7) * std::numbers::pi / 4 + random.between(0, 1) * random.uniform(0.0, 6.0);
      Cells col(count), row(count), expected_col(count), expected_row(count);
      kernels::end_point_cells(x.data(), y.data(), count, std::cos(heading_rad), std::sin(heading_rad),
                               col.data(), row.data());
      kernels::scalar::end_point_cells(x.data(), y.data(), count, std::cos(heading_rad),
                                       std::sin(heading_rad), expected_col.data(), expected_row.data());
      EXPECT_EQ(col, expected_col) << points;
      EXPECT_EQ(row, expected_row) << points;
    }
  }
}

}  // namespace
}  // namespace landfall
