#include "kernels/bound_tile.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <utility>

#include "instruction_sets.hpp"
#include "random_field.hpp"

namespace landfall {
namespace {

using kernels::tile_blocks;
using kernels::tile_cols;
using kernels::tile_rows;
using Integers = std::vector<std::int32_t>;

struct Bounds {
  std::vector<std::uint16_t> sums;
  std::vector<std::uint16_t> largest;
  friend bool operator==(const Bounds&, const Bounds&) = default;
};

// Planes of random levels, and points of random weights as lists of their bits.
struct TileRun {
  static constexpr int planes_kept = 3;

  int cols, rows;
  std::vector<std::uint32_t> column_of_4;
  Integers plane, col, row, first_byte, list_begin, list_end;
  int tile_col, tile_row, tiles;
  std::vector<std::uint64_t> allowed;
  std::size_t listed = 0;

  // `inside`: no point's run of tiles begins beyond the planes.
  TileRun(testing::RandomField& random, int points, int heaviest, bool inside = false)
      : cols(kernels::run_cols + random.between(0, 90)),
        rows(tile_rows + random.between(0, 30)),
        tile_col(inside ? cols / 2 : random.between(-10, cols)),
        tile_row(inside ? rows / 2 : random.between(-10, rows)),
        tiles(random.between(1, kernels::most_tiles)) {
    const std::vector<std::uint8_t> levels =
        random.bytes(4 * testing::area(planes_kept * cols, rows), kernels::bound_levels);
    for (std::size_t i = 0; i < levels.size(); i += 4)
      column_of_4.push_back(levels[i] | levels[i + 1] << 8U | levels[i + 2] << 16U |
                            static_cast<std::uint32_t>(levels[i + 3]) << 24U);
    const auto count = static_cast<std::size_t>(points);
    const Integers weights = random.integers(count, 1, heaviest);
    const Integers planes_of = random.integers(count, 0, planes_kept - 1);
    const int last_col = cols - kernels::run_cols;
    const int last_row = rows - tile_rows;
    const Integers cols_of =
        inside ? random.integers(count, -tile_col, last_col - tile_col) : random.integers(count, -cols, cols);
    const Integers rows_of =
        inside ? random.integers(count, -tile_row, last_row - tile_row) : random.integers(count, -rows, rows);
    for (int bit = static_cast<int>(std::bit_width(static_cast<unsigned>(heaviest))) - 1; bit >= 0; --bit) {
      list_begin.push_back(static_cast<std::int32_t>(plane.size()));
      for (std::size_t i = 0; i < count; ++i) {
        if (((weights[i] >> bit) & 1) == 0) continue;
        plane.push_back(planes_of[i] * cols * rows);
        col.push_back(cols_of[i]);
        row.push_back(rows_of[i]);
        first_byte.push_back(4 * (plane.back() + row.back() * cols + col.back()));
      }
      list_end.push_back(static_cast<std::int32_t>(plane.size()));
    }
    for (int tile = 0; tile < tiles; ++tile) {
      allowed.push_back(0);
      for (int lane = 0; lane < tile_blocks; ++lane)
        if (random.between(0, 3) != 0) allowed.back() |= std::uint64_t{1} << lane;
    }
    listed = plane.size();
    for (Integers* padded : {&plane, &col, &row, &first_byte})
      padded->resize(padded->size() + kernels::point_padding);
  }

  [[nodiscard]] kernels::BoundPlanes planes() const {
    return {.column_of_4 = column_of_4.data(),
            .stride = cols,
            .last_col = cols - kernels::run_cols,
            .last_row = rows - tile_rows};
  }
  [[nodiscard]] kernels::BoundPoints points() const {
    const auto range = [&](const Integers& of) {
      const auto end = of.begin() + static_cast<std::ptrdiff_t>(listed);
      const auto [least, most] = std::minmax_element(of.begin(), end);
      return listed == 0 ? std::pair(0, 0) : std::pair(*least, *most);
    };
    return {.plane = plane.data(),
            .col = col.data(),
            .row = row.data(),
            .first_byte = first_byte.data(),
            .list_begin = list_begin.data(),
            .list_end = list_end.data(),
            .lists = static_cast<std::int32_t>(list_end.size()),
            .least_col = range(col).first,
            .most_col = range(col).second,
            .least_row = range(row).first,
            .most_row = range(row).second};
  }
  template <class Kernel>
  [[nodiscard]] Bounds run(const Kernel& kernel, int threshold) const {
    Bounds bounds{.sums = std::vector<std::uint16_t>(allowed.size() * tile_blocks),
                  .largest = std::vector<std::uint16_t>(static_cast<std::size_t>(tiles))};
    Integers scratch(plane.size() + 1);
    kernel(planes(), points(), tile_col, tile_row, tiles, threshold, allowed.data(), scratch.data(),
           bounds.sums.data(), bounds.largest.data());
    return bounds;
  }
  [[nodiscard]] Bounds bound(int threshold) const { return run(kernels::bound_tiles, threshold); }
  [[nodiscard]] Bounds twin() const { return run(kernels::scalar::bound_tiles, 0); }
};

TEST(BoundTileByHand, LanesCoverTheTile) {
  std::vector<int> seen(tile_blocks);
  for (int row = 0; row < tile_rows; ++row)
    for (int col = 0; col < tile_cols; ++col) {
      const int lane = kernels::tile_lane(col, row);
      EXPECT_EQ(kernels::lane_col(lane), col);
      EXPECT_EQ(kernels::lane_row(lane), row);
      ++seen[static_cast<std::size_t>(lane)];
    }
  EXPECT_EQ(seen, std::vector<int>(tile_blocks, 1));
}

// The twin by hand: three points, of weight 1, 2 and 3, over one plane that counts its own bytes.
TEST(BoundTileByHand, WeighsPointsByTheirLists) {
  constexpr int cols = kernels::run_cols + 2;
  const auto level = [](int c, int r) { return static_cast<std::uint32_t>((r * cols + c) % 7); };
  std::vector<std::uint32_t> column_of_4;
  for (int r = 0; r < 8; ++r)
    for (int c = 0; c < cols; ++c)
      column_of_4.push_back(level(c, r) | level(c, r + 1) << 8U | level(c, r + 2) << 16U |
                            level(c, r + 3) << 24U);
  const Integers plane(4, 0);
  const Integers col{1, 2, 0, 2};  // list of 2: b, c; list of 1: a, c
  const Integers row{0, 1, 0, 1};
  const Integers list_begin{0, 2};
  const Integers list_end{2, 4};
  const std::uint64_t allowed = ~std::uint64_t{0};
  std::vector<std::uint16_t> sums(tile_blocks);
  std::uint16_t largest = 0;
  kernels::scalar::bound_tiles(
      {.column_of_4 = column_of_4.data(), .stride = cols, .last_col = 2, .last_row = 2},
      {.plane = plane.data(),
       .col = col.data(),
       .row = row.data(),
       .first_byte = nullptr,
       .list_begin = list_begin.data(),
       .list_end = list_end.data(),
       .lists = 2},
      0, 0, 1, 1, &allowed, nullptr, sums.data(), &largest);
  // Block (col 3, row 1): b at (1, 0), weight 2; c at (2, 1), weight 3; a at (0, 0), weight 1.
  EXPECT_EQ(sums[static_cast<std::size_t>(kernels::tile_lane(3, 1))],
            level(3, 1) + 2 * level(4, 1) + 3 * level(5, 2));
  EXPECT_EQ(largest, *std::max_element(sums.begin(), sums.end()));
}

class BoundTile : public ::testing::TestWithParam<std::string> {
 protected:
  testing::UsedInstructionSet used_{GetParam()};
  testing::RandomField random_{4};
};

TEST_P(BoundTile, EqualsItsTwin) {
  for (const int points : testing::point_counts)
    for (const int heaviest : {1, 2, 3, 7, 8, 20})
      for (int repeat = 0; repeat < 6; ++repeat) {
        const TileRun run(random_, points, heaviest, repeat >= 4);
        EXPECT_EQ(run.bound(0), run.twin())
            << points << " points up to weight " << heaviest << ", " << run.tiles << " tiles";
      }
}

TEST_P(BoundTile, GivesUpOnlyTilesThatDoNotReachTheThreshold) {
  int given_up = 0;
  for (const int points : testing::point_counts) {
    for (int repeat = 0; repeat < 4; ++repeat) {
      const TileRun run(random_, points, 5);
      const Bounds expected = run.twin();
      const int largest = *std::max_element(expected.largest.begin(), expected.largest.end());
      for (const int threshold : {0, largest / 2, largest, largest + 1}) {
        const Bounds found = run.bound(threshold);
        for (std::size_t tile = 0; tile < expected.largest.size(); ++tile) {
          if (found.largest[tile] == 0 && expected.largest[tile] < threshold) {
            ++given_up;
            continue;
          }
          ASSERT_EQ(found.largest[tile], expected.largest[tile]) << points << " points, " << threshold;
          for (std::size_t i = tile * tile_blocks; i < (tile + 1) * tile_blocks; ++i)
            ASSERT_EQ(found.sums[i], expected.sums[i]);
        }
      }
    }
  }
  EXPECT_TRUE(given_up > 0 || GetParam() == "SCALAR");
}

TEST_P(BoundTile, SaturatesAtSixteenBits) {
  TileRun run(random_, 300, 31);
  std::fill(run.column_of_4.begin(), run.column_of_4.end(), 0x1F1F1F1FU);
  std::fill(run.allowed.begin(), run.allowed.end(), ~std::uint64_t{0});
  const Bounds full{.sums = std::vector<std::uint16_t>(run.allowed.size() * tile_blocks, 65535),
                    .largest = std::vector<std::uint16_t>(static_cast<std::size_t>(run.tiles), 65535)};
  EXPECT_EQ(run.bound(65535), full);
  EXPECT_EQ(run.twin(), full);
}

// Some blocks saturated, some not: sums of large weights over levels of few kinds.
TEST_P(BoundTile, EqualsItsTwinAroundSaturation) {
  for (const int points : {60, 257, 1000}) {
    const TileRun run(random_, points, 255);
    EXPECT_EQ(run.bound(0), run.twin()) << points;
  }
}

TEST_P(BoundTile, LanesAtLeastEqualTheirTwin) {
  std::vector<std::uint16_t> sums(tile_blocks);
  for (int repeat = 0; repeat < 50; ++repeat) {
    for (std::uint16_t& sum : sums) sum = static_cast<std::uint16_t>(random_.between(0, 3) * 21845);
    for (const int least : {0, 1, 21845, 43690, 43691, 65535})
      ASSERT_EQ(kernels::lanes_at_least(sums.data(), least),
                kernels::scalar::lanes_at_least(sums.data(), least))
          << least;
  }
  EXPECT_EQ(kernels::scalar::lanes_at_least(sums.data(), 0), ~std::uint64_t{0});
}

INSTANTIATE_TEST_SUITE_P(InstructionSets, BoundTile, ::testing::ValuesIn(testing::instruction_sets()),
                         [](const auto& set) { return set.param; });

}  // namespace
}  // namespace landfall
