#include "kernels/march_rays.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "instruction_sets.hpp"
#include "random_field.hpp"
#include "raycast/free_squares.hpp"

namespace landfall {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();

// Arrays of rays, filled up to whole batches with rays that are not cast.
struct Rays {
  std::vector<std::int32_t> cell;
  std::vector<float> x, y, dx, dy, range_max;

  void add(std::int32_t from, float in_x, float in_y, float direction_x, float direction_y, float limit) {
    cell.push_back(from);
    x.push_back(in_x);
    y.push_back(in_y);
    dx.push_back(direction_x);
    dy.push_back(direction_y);
    range_max.push_back(limit);
  }
  void fill_batch() {
    while (cell.size() % kernels::march_multiple != 0) add(0, 0.0f, 0.0f, 1.0f, 0.0f, -1.0f);
  }
  [[nodiscard]] kernels::Marches view() const {
    return {.start_cell = cell.data(),
            .x = x.data(),
            .y = y.data(),
            .dx = dx.data(),
            .dy = dy.data(),
            .range_max = range_max.data()};
  }
};

raycast::FreeSquareTable table_of(const std::vector<std::uint8_t>& cells, int width, int height) {
  return raycast::FreeSquareTable({.cells = cells, .width_cells = width, .height_cells = height});
}

TEST(MarchRays, EndsAtTheFaceOfTheObstacle) {
  const std::vector<std::uint8_t> cells{0, 0, 0, 0, 1,  //
                                        0, 0, 0, 0, 0,  //
                                        1, 0, 0, 0, 0};
  const raycast::FreeSquareTable table = table_of(cells, 5, 3);
  Rays rays;
  const auto add = [&](int col, int row, float dx, float dy, float limit = 100.0f) {
    rays.add(table.index(col, row), 0.25f, 0.5f, dx, dy, limit);
  };
  add(0, 0, 1.0f, 0.0f);                        // from x = 0.25 to 4
  add(0, 0, 1.0f, 0.0f, 3.7f);                  // not so far
  add(0, 0, 0.0f, 1.0f);                        // from y = 0.5 to 2
  add(4, 2, -1.0f, 0.0f);                       // from x = 4.25 to 1
  add(4, 2, 0.0f, -1.0f);                       // from y = 2.5 to 1
  add(0, 1, 1.0f, 0.0f);                        // leaves the grid
  add(0, 0, 0.8f, 0.6f);                        // over (2.25, 2) and out at the top
  add(4, 0, 1.0f, 0.0f);                        // starts in an obstacle
  rays.add(0, 0.5f, 0.5f, 1.0f, 0.0f, 100.0f);  // starts on the ring
  rays.fill_batch();
  const std::vector<float> expected{3.75f, infinity, 1.5f, 3.25f, 1.5f, infinity, infinity, 0.0f, infinity};
  for (const std::string& name : testing::instruction_sets()) {
    const testing::UsedInstructionSet used(name);
    std::vector<float> range(rays.cell.size());
    kernels::march_rays(table.view(), rays.view(), range.size(), range.data());
    for (std::size_t i = 0; i < expected.size(); ++i)
      EXPECT_EQ(range[i], expected[i]) << name << " ray " << i;
    EXPECT_EQ(range.back(), infinity) << name;
  }
}

Rays random_rays(testing::RandomField& random, const raycast::FreeSquareTable& table, int width, int height,
                 int count) {
  Rays rays;
  for (int i = 0; i < count; ++i) {
    const double theta_rad = i % 5 == 0 ? 0.5 * std::numbers::pi * random.between(-2, 2)
                                        : random.uniform(-std::numbers::pi, std::numbers::pi);
    const auto place = [&] { return i % 7 == 0 ? 0.0f : static_cast<float>(random.uniform(0.0, 0.999)); };
    const float x = place();
    rays.add(table.index(random.between(0, width - 1), random.between(0, height - 1)), x, place(),
             static_cast<float>(std::cos(theta_rad)), static_cast<float>(std::sin(theta_rad)),
             static_cast<float>(random.uniform(-1.0, 60.0)));
  }
  rays.fill_batch();
  return rays;
}

TEST(MarchRays, EqualsItsTwinOnEveryInstructionSet) {
  testing::RandomField random(5);
  for (const std::string& name : testing::instruction_sets()) {
    SCOPED_TRACE(name);
    const testing::UsedInstructionSet used(name);
    int hits = 0;
    for (const int width : {1, 2, 17, 90, 300}) {
      for (const int count : {0, 1, 16, 17, 255, 256, 257, 900}) {
        const int height = random.between(1, 70);
        std::vector<std::uint8_t> cells(testing::area(width, height));
        for (std::uint8_t& cell : cells) cell = random.between(0, 40) == 0 ? 1 : 0;
        const raycast::FreeSquareTable table = table_of(cells, width, height);
        const Rays rays = random_rays(random, table, width, height, count);
        std::vector<float> range(rays.cell.size(), 7.0f);
        std::vector<float> expected(rays.cell.size(), 8.0f);
        kernels::march_rays(table.view(), rays.view(), range.size(), range.data());
        kernels::scalar::march_rays(table.view(), rays.view(), expected.size(), expected.data());
        ASSERT_EQ(range, expected) << width << " columns, " << count << " rays";
        for (const float r : range) hits += r < infinity ? 1 : 0;
      }
    }
    EXPECT_GT(hits, 1000);
  }
}

}  // namespace
}  // namespace landfall
