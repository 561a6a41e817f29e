#include "kernels/merge_windows.hpp"

#include <gtest/gtest.h>

#include <array>
#include <bit>
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

// The lists of bits 0, 1, ...; none of those above the highest bit of any weight.
struct Merged {
  kernels::MergedCount count;
  std::vector<Integers> plane, col, row, first_byte;
  friend bool operator==(const Merged&, const Merged&) = default;
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
    const std::size_t points = col_half.size();
    const std::size_t room = kernels::lists_room(points);
    const auto most_lists = static_cast<std::size_t>(kernels::list_count(points));
    Integers plane(room), col(room), row(room), first_byte(room), begin(most_lists), end(most_lists);
    Integers run_begin(points + kernels::point_padding);
    Merged merged;
    merged.count =
        kernel(col_half.data(), row_half.data(), size_halves.data(), points, make_shelf(), run_begin.data(),
               {.plane = plane.data(),
                .col = col.data(),
                .row = row.data(),
                .first_byte = first_byte.data(),
                .begin = begin.data(),
                .end = end.data()});
    const auto lists = static_cast<std::size_t>(std::bit_width(static_cast<unsigned>(merged.count.weights)));
    for (std::size_t bit = 0; bit < lists; ++bit) {
      const auto listed = [&](const Integers& all) {
        return Integers(all.begin() + begin[bit], all.begin() + end[bit]);
      };
      merged.plane.push_back(listed(plane));
      merged.col.push_back(listed(col));
      merged.row.push_back(listed(row));
      merged.first_byte.push_back(listed(first_byte));
    }
    for (std::size_t bit = lists; bit < most_lists; ++bit) EXPECT_EQ(begin[bit], end[bit]);
    return merged;
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
  const Merged merged = windows.merge(kernels::scalar::merge_windows);
  EXPECT_EQ(merged.plane, (std::vector<Integers>{{6000, 1000}, {1000}}));
  EXPECT_EQ(merged.col, (std::vector<Integers>{{10, 5}, {5}}));
  EXPECT_EQ(merged.row, (std::vector<Integers>{{7, 7}, {7}}));
  EXPECT_EQ(merged.first_byte, (std::vector<Integers>{{4 * (6000 + 7 * 40 + 10), 4 * (1000 + 7 * 40 + 5)},
                                                      {4 * (1000 + 7 * 40 + 5)}}));
  EXPECT_EQ(merged.count.unbounded, 4);
  EXPECT_EQ(merged.count.weights, 3);
  EXPECT_EQ(merged.count.least_col, 5);
  EXPECT_EQ(merged.count.most_col, 10);
  EXPECT_EQ(merged.count.least_row, 7);
  EXPECT_EQ(merged.count.most_row, 7);
}

// A list is as long as it can be: of n points n / 2 pairs.
TEST(MergeWindowsByHand, ListsHaveRoomForAllThatCanStandInThem) {
  for (const int weight : {1, 2, 3, 4, 7}) {
    Windows windows;
    for (int i = 0; i < 100; ++i) windows.add(i, 0, 3, weight);
    const Merged merged = windows.merge(kernels::scalar::merge_windows);
    for (std::size_t bit = 0; bit < merged.col.size(); ++bit)
      EXPECT_EQ(merged.col[bit].size(), ((weight >> bit) & 1) == 1 ? 100U : 0U);
  }
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

INSTANTIATE_TEST_SUITE_P(InstructionSets, MergeWindows, ::testing::ValuesIn(testing::instruction_sets()),
                         [](const auto& set) { return set.param; });

}  // namespace
}  // namespace landfall
