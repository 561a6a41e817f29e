#include "kernels/merge_windows.hpp"

#include <gtest/gtest.h>

#include <array>
#include <vector>

#include "instruction_sets.hpp"
#include "kernels/bound_tile.hpp"
#include "random_field.hpp"

namespace landfall {
namespace {

using Integers = std::vector<std::int32_t>;

// Planes of 1,000 elements, 40 a row; windows of up to 10 halves.
kernels::WindowShelf make_shelf() {
  kernels::WindowShelf shelf{
      .plane_of_size = {}, .plane_size = 1000, .stride = 40, .pad_cols = 7, .pad_rows = 5};
  for (int size = 0; size < kernels::WindowShelf::sizes; ++size)
    shelf.plane_of_size[size] = size <= 4 ? 0 : size <= 10 ? 4000 : -1;
  return shelf;
}

struct Merged {
  kernels::MergedCount count;
  Integers plane, col, row, weight;
  friend bool operator==(const Merged&, const Merged&) = default;
};

struct Listed {
  Integers plane, col, row, first_byte;
  friend bool operator==(const Listed&, const Listed&) = default;
};

struct Windows {
  Integers col_half, row_half, size_halves;

  void add(std::int32_t col, std::int32_t row, std::int32_t size, int times) {
    for (int i = 0; i < times; ++i) {
      col_half.push_back(col);
      row_half.push_back(row);
      size_halves.push_back(size);
    }
  }
  template <class Kernel>
  [[nodiscard]] Merged merge(const Kernel& kernel) const {
    const std::size_t room = col_half.size() + kernels::point_padding;
    Merged merged{.count = {},
                  .plane = Integers(room),
                  .col = Integers(room),
                  .row = Integers(room),
                  .weight = Integers(room)};
    Integers run_begin(room);
    merged.count = kernel(col_half.data(), row_half.data(), size_halves.data(), col_half.size(), make_shelf(),
                          run_begin.data(), view(merged));
    for (Integers* numbers : {&merged.plane, &merged.col, &merged.row, &merged.weight})
      numbers->resize(merged.count.windows);
    return merged;
  }
  static kernels::MergedWindows view(Merged& merged) {
    return {.plane = merged.plane.data(),
            .col = merged.col.data(),
            .row = merged.row.data(),
            .weight = merged.weight.data()};
  }
};

// As they come out of a scan: runs of equal ones, some off the map (size 0), some too wide.
Windows random_windows(testing::RandomField& random, int points) {
  constexpr std::array sizes{0, 3, 4, 5, 10, 11, 40};
  Windows windows;
  while (windows.col_half.size() < static_cast<std::size_t>(points)) {
    const int left = points - static_cast<int>(windows.col_half.size());
    windows.add(random.between(-9, 9), random.between(-9, 9),
                sizes[static_cast<std::size_t>(random.between(0, sizes.size() - 1))],
                std::min(left, random.between(0, 4) == 0 ? random.between(1, 300) : random.between(1, 3)));
  }
  return windows;
}

TEST(MergeWindowsByHand, SaysWhereAWindowStands) {
  Windows windows;
  windows.add(-3, 4, 3, 2);  // odd column, even row
  windows.add(6, 5, 10, 1);  // even column, odd row
  windows.add(1, 1, 0, 5);   // off the map
  windows.add(1, 1, 11, 4);  // too wide
  windows.add(-3, 4, 3, 1);  // no neighbour of the first two
  Merged merged = windows.merge(kernels::scalar::merge_windows);
  EXPECT_EQ(merged.plane, (Integers{1000, 6000, 1000}));
  EXPECT_EQ(merged.col, (Integers{5, 10, 5}));
  EXPECT_EQ(merged.row, (Integers{7, 7, 7}));
  EXPECT_EQ(merged.weight, (Integers{2, 1, 1}));
  EXPECT_EQ(merged.count.unbounded, 4);
  EXPECT_EQ(merged.count.weights, 3);
  EXPECT_EQ(merged.count.least_col, 5);
  EXPECT_EQ(merged.count.most_col, 10);
  EXPECT_EQ(merged.count.least_row, 7);
  EXPECT_EQ(merged.count.most_row, 7);
  Integers plane(3), col(3), row(3), first_byte(3);
  ASSERT_EQ(kernels::scalar::list_windows(Windows::view(merged), 3, 0, 40, plane.data(), col.data(),
                                          row.data(), first_byte.data()),
            2U);
  EXPECT_EQ(plane, (Integers{6000, 1000, 0}));
  EXPECT_EQ(first_byte, (Integers{4 * (6000 + 7 * 40 + 10), 4 * (1000 + 7 * 40 + 5), 0}));
}

class MergeWindows : public ::testing::TestWithParam<std::string> {
 protected:
  testing::UsedInstructionSet used_{GetParam()};
  testing::RandomField random_{10};
};

TEST_P(MergeWindows, EqualsItsTwin) {
  for (const int points : testing::point_counts)
    for (int repeat = 0; repeat < 5; ++repeat) {
      const Windows windows = random_windows(random_, points);
      EXPECT_EQ(windows.merge(kernels::merge_windows), windows.merge(kernels::scalar::merge_windows))
          << points;
    }
}

TEST_P(MergeWindows, ListsEqualTheirTwins) {
  for (const int points : testing::point_counts) {
    Merged merged = random_windows(random_, points).merge(kernels::scalar::merge_windows);
    const std::size_t windows = merged.count.windows;
    for (Integers* numbers : {&merged.plane, &merged.col, &merged.row, &merged.weight})
      numbers->resize(windows + kernels::point_padding, -1);
    const auto list = [&](const auto& kernel, int bit) {
      const std::size_t room = windows + kernels::point_padding;
      Listed listed{Integers(room), Integers(room), Integers(room), Integers(room)};
      const std::size_t count = kernel(Windows::view(merged), windows, bit, 40, listed.plane.data(),
                                       listed.col.data(), listed.row.data(), listed.first_byte.data());
      for (Integers* numbers : {&listed.plane, &listed.col, &listed.row, &listed.first_byte})
        numbers->resize(count);
      return listed;
    };
    for (const int bit : {0, 1, 2, 8})
      EXPECT_EQ(list(kernels::list_windows, bit), list(kernels::scalar::list_windows, bit)) << points;
  }
}

INSTANTIATE_TEST_SUITE_P(InstructionSets, MergeWindows, ::testing::ValuesIn(testing::instruction_sets()),
                         [](const auto& set) { return set.param; });

}  // namespace
}  // namespace landfall
