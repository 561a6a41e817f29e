#include "kernels/distance.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include "random_field.hpp"

namespace landfall {
namespace {

using Distances = std::vector<std::uint16_t>;
using Squared = std::vector<std::int32_t>;

struct Picture {
  int width, height;
  std::vector<std::uint8_t> occupied;

  [[nodiscard]] bool at(int col, int row) const { return occupied.data()[row * width + col] != 0; }
  [[nodiscard]] std::int32_t squared_by_brute_force(int col, int row) const {
    std::int32_t least = kernels::far_squared;
    for (int r = 0; r < height; ++r)
      for (int c = 0; c < width; ++c)
        if (at(c, r)) least = std::min(least, (c - col) * (c - col) + (r - row) * (r - row));
    return least;
  }
  [[nodiscard]] Distances columns(int cap) const {
    Distances distance(occupied.size());
    const int middle = width / 2;  // in two parts, as tasks would
    kernels::column_distances(occupied.data(), width, height, cap, 0, middle, distance.data());
    kernels::column_distances(occupied.data(), width, height, cap, middle, width, distance.data());
    return distance;
  }
};

Picture random_picture(testing::RandomField& random) {
  Picture picture{.width = random.between(1, 40), .height = random.between(1, 40), .occupied = {}};
  picture.occupied.resize(testing::area(picture.width, picture.height));
  const int one_in = random.between(0, 3) == 0 ? 2 : 60;
  for (std::uint8_t& cell : picture.occupied) cell = random.between(1, one_in) == 1 ? 1 : 0;
  if (random.between(0, 9) == 0) std::fill(picture.occupied.begin(), picture.occupied.end(), std::uint8_t{0});
  return picture;
}

TEST(ColumnDistances, CountCellsUpAndDown) {
  //   column:  0  1  2
  const Picture picture{.width = 3,
                        .height = 5,
                        .occupied = {0, 0, 1,  //
                                     0, 0, 0,  //
                                     1, 0, 0,  //
                                     0, 0, 0,  //
                                     0, 0, 1}};
  EXPECT_EQ(picture.columns(6), (Distances{2, 6, 0, 1, 6, 1, 0, 6, 2, 1, 6, 1, 2, 6, 0}));
  EXPECT_EQ(picture.columns(2), (Distances{2, 2, 0, 1, 2, 1, 0, 2, 2, 1, 2, 1, 2, 2, 0}));  // capped
}

TEST(ExactRow, EqualsBruteForce) {
  testing::RandomField random(5);
  for (int picture_number = 0; picture_number < 300; ++picture_number) {
    const Picture picture = random_picture(random);
    const Distances columns = picture.columns(picture.height + 1);
    Squared scratch(2 * (static_cast<std::size_t>(picture.width) + 1));
    Squared squared(static_cast<std::size_t>(picture.width));
    for (int row = 0; row < picture.height; ++row) {
      kernels::exact_row(columns.data() + row * picture.width, picture.width, picture.height + 1,
                         scratch.data(), squared.data());
      for (int col = 0; col < picture.width; ++col)
        ASSERT_EQ(squared[static_cast<std::size_t>(col)], picture.squared_by_brute_force(col, row))
            << "picture " << picture_number << ", col " << col << ", row " << row;
    }
  }
}

TEST(ClampedRow, EqualsBruteForceUpToItsRadius) {
  testing::RandomField random(6);
  for (int picture_number = 0; picture_number < 300; ++picture_number) {
    const Picture picture = random_picture(random);
    const int radius = random.between(0, 50);
    const Distances columns = picture.columns(radius + 1);
    Squared squared(static_cast<std::size_t>(picture.width));
    for (int row = 0; row < picture.height; ++row) {
      kernels::clamped_row(columns.data() + row * picture.width, picture.width, radius, squared.data());
      for (int col = 0; col < picture.width; ++col)
        ASSERT_EQ(squared[static_cast<std::size_t>(col)],
                  std::min((radius + 1) * (radius + 1), picture.squared_by_brute_force(col, row)))
            << "picture " << picture_number << ", radius " << radius << ", col " << col << ", row " << row;
    }
  }
}

TEST(ExactRow, StaysExactAcrossTheWidestMap) {
  constexpr int width = 65'000;
  constexpr int cap = 65'001;
  Distances columns(width, cap);
  columns[0] = 0;
  columns[width - 1] = 20'000;
  Squared scratch(2 * (width + 1)), squared(width);
  kernels::exact_row(columns.data(), width, cap, scratch.data(), squared.data());
  EXPECT_EQ(squared[30'000], 900'000'000);
  EXPECT_EQ(squared[width - 1], 400'000'000);
  EXPECT_EQ(squared[33'000], kernels::far_squared);  // 33,000^2 is beyond 2^30, as is the other one's
}

}  // namespace
}  // namespace landfall
