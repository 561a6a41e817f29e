// Correlation by transforms against direct sums.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "drawn_map.hpp"
#include "engine/methods/fft/correlator.hpp"
#include "landfall/correlation.hpp"
#include "landfall/error.hpp"
#include "random_world.hpp"
#include "rooms.hpp"

namespace landfall {
namespace {

using internal::CorrelationTiles;
using internal::Correlator;
using internal::HeadingCells;
using internal::MapSpectra;
using testing::Dice;

struct Field {
  int width, height;
  std::vector<float> values;

  [[nodiscard]] float at(int col, int row) const {
    return col < 0 || row < 0 || col >= width || row >= height
               ? 0.0F
               : values[static_cast<std::size_t>(row) * static_cast<std::size_t>(width) +
                        static_cast<std::size_t>(col)];
  }
  [[nodiscard]] double sum(const HeadingCells& points, int col, int row) const {
    double sum = 0.0;
    for (std::size_t i = 0; i < points.col.size(); ++i)
      sum += static_cast<double>(at(col + points.col[i], row + points.row[i]));
    return sum;
  }
};

Field random_field(Dice& dice, int width, int height) {
  Field field{.width = width, .height = height, .values = {}};
  const double share = dice.one_of({0.02, 0.3, 1.0});
  for (int i = 0; i < width * height; ++i)
    field.values.push_back(dice.chance(share) ? static_cast<float>(dice.between(0, 255)) : 0.0F);
  return field;
}

HeadingCells random_points(Dice& dice, int count, int reach) {
  HeadingCells points;
  for (int i = 0; i < count; ++i) {
    points.col.push_back(dice.between(-reach, reach));
    points.row.push_back(dice.between(-reach, reach));
  }
  return points;
}

// The largest difference to the direct sum, over the error bound.
double expect_equal_to_direct_sums(const Field& field, const HeadingCells& points,
                                   const CorrelationTiles& tiles) {
  const MapSpectra spectra(field.values, tiles);
  Correlator correlator(spectra);
  correlator.draw({.col = {0, 0, 0}, .row = {0, 0, 0}});  // leaves nothing behind
  correlator.draw(points);
  double worst = 0.0;
  int wrong = 0;
  for (int tile = 0; tile < tiles.count(); ++tile) {
    correlator.correlate(tile);
    const int rows = std::min(tiles.tile_height_cells, field.height - tiles.first_row(tile));
    const int cols = std::min(tiles.tile_width_cells, field.width - tiles.first_col(tile));
    for (int row = 0; row < rows; ++row) {
      for (int col = 0; col < cols; ++col) {
        const auto sum = static_cast<double>(
            correlator
                .sums()[static_cast<std::size_t>(row) * correlator.stride() + static_cast<std::size_t>(col)]);
        const double direct = field.sum(points, tiles.first_col(tile) + col, tiles.first_row(tile) + row);
        worst = std::max(worst, std::abs(sum - direct));
        wrong += std::lround(sum) == std::lround(direct) ? 0 : 1;
      }
    }
  }
  EXPECT_EQ(wrong, 0);
  EXPECT_LE(worst, correlator.error_bound());
  return worst / correlator.error_bound();
}

TEST(FftVolume, EqualsDirectSumsOnRandomSizes) {
  Dice dice(1);
  for (int i = 0; i < 40 && !::testing::Test::HasFailure(); ++i) {
    const int width = i < 20 ? dice.one_of({1, 2, 3, 7, 13, 31, 53, 61, 73}) : dice.between(1, 90);
    const int height = i < 20 ? dice.one_of({1, 2, 5, 11, 17, 37, 59, 71}) : dice.between(1, 90);
    SCOPED_TRACE(std::to_string(width) + " x " + std::to_string(height));
    const int reach = dice.between(0, std::max(width, height));
    expect_equal_to_direct_sums(random_field(dice, width, height),
                                random_points(dice, dice.one_of({1, 10, 300}), reach),
                                internal::whole_map(width, height, reach));
  }
}

TEST(FftVolume, EqualsDirectSumsInOverlappingTiles) {
  Dice dice(2);
  for (const auto& [width, height, reach, fft_cells] :
       {std::tuple{97, 61, 10, 32}, {64, 64, 4, 32}, {131, 40, 20, 64}, {33, 129, 0, 16}, {40, 40, 11, 32}}) {
    SCOPED_TRACE(std::to_string(width) + " x " + std::to_string(height));
    const CorrelationTiles tiles = internal::square_tiles(width, height, reach, fft_cells);
    EXPECT_GT(tiles.count(), 1);
    expect_equal_to_direct_sums(random_field(dice, width, height), random_points(dice, 200, reach), tiles);
  }
}

// All cells and points alike: rounding errors have a direction.
TEST(FftVolume, ErrorBoundHoldsForConstantFields) {
  Field field{.width = 211, .height = 199, .values = std::vector<float>(211 * 199, 255.0F)};
  HeadingCells points;
  points.col.assign(3000, 5);
  points.row.assign(3000, -7);
  const MapSpectra spectra(field.values, internal::whole_map(211, 199, 40));
  Correlator correlator(spectra);
  correlator.draw(points);
  correlator.correlate(0);
  double worst = 0.0;
  for (int row = 0; row < 199; ++row)
    for (int col = 0; col < 211; ++col) {
      const float sum =
          correlator
              .sums()[static_cast<std::size_t>(row) * correlator.stride() + static_cast<std::size_t>(col)];
      worst = std::max(worst, std::abs(static_cast<double>(sum) - field.sum(points, col, row)));
    }
  EXPECT_LE(worst, correlator.error_bound());
  EXPECT_GT(worst, 0.0);
}

// The paper's transforms are as large as the map: a robot at the right edge sees the wall at the left one.
TEST(FftVolume, NothingWrapsAroundTheEdge) {
  const Field field{.width = 8, .height = 8, .values = [] {
                      std::vector<float> values(64);
                      values[3 * 8 + 0] = 100.0F;  // row 3, column 0
                      return values;
                    }()};
  const HeadingCells two_ahead{.col = {2}, .row = {0}};
  const auto sum_at = [&](const CorrelationTiles& tiles, std::size_t row, std::size_t col) {
    const MapSpectra spectra(field.values, tiles);
    Correlator correlator(spectra);
    correlator.draw(two_ahead);
    correlator.correlate(0);
    return std::lround(correlator.sums()[row * correlator.stride() + col]);
  };
  const CorrelationTiles padded = internal::whole_map(8, 8, 2);
  CorrelationTiles unpadded = padded;
  unpadded.fft_cols = unpadded.fft_rows = 8;
  EXPECT_EQ(sum_at(unpadded, 3, 6), 100);
  EXPECT_EQ(sum_at(padded, 3, 6), 0);
}

TEST(FftVolume, IsTheFieldScoreOfEveryPose) {
  const PreparedMap map(testing::furnished_room({3.0, -2.0, 0.5}));
  const Scan scan = testing::look(map, testing::full_circle(90), {5.0, 1.0, 0.3});
  const CorrelationVolume volume =
      correlation_volume(map, scan, {.rotation_step_rad = 2.0 * std::numbers::pi / 8});
  ASSERT_EQ(volume.headings, 8);
  ASSERT_EQ(volume.scores.size(), 8U * 60U * 80U);
  const internal::Lattice lattice = internal::make_lattice(map.grid(), 0.0, 2.0 * std::numbers::pi / 8);
  const internal::EndPoints points = internal::make_end_points(scan, 0.1);
  const Field field{.width = 80, .height = 60, .values = {map.field().begin(), map.field().end()}};
  HeadingCells cells;
  int wrong = 0;
  for (int heading = 0; heading < 8; ++heading) {
    internal::cells_at_heading(points, lattice, heading, cells);
    for (int row = 0; row < 60; ++row)
      for (int col = 0; col < 80; ++col)
        wrong += static_cast<double>(std::round(volume.at(heading, {col, row}))) == field.sum(cells, col, row)
                     ? 0
                     : 1;
  }
  EXPECT_EQ(wrong, 0);
}

TEST(FftVolume, IsTheSameOnAnyNumberOfThreads) {
  const PreparedMap map(testing::furnished_room());
  const Scan scan = testing::look(map, testing::full_circle(90), {3.0, 2.0, 0.3});
  const CorrelationVolume one = correlation_volume(map, scan, {.rotation_step_rad = 0.1, .threads = 1});
  EXPECT_EQ(correlation_volume(map, scan, {.rotation_step_rad = 0.1, .threads = 2}).scores, one.scores);
}

TEST(FftVolume, TakesAnyValues) {
  const GridMap grid = testing::drawn_map({"...", "...", "..."});
  const auto sensor = std::make_shared<const Sensor>(make_fan({.beams = 1, .range_max_m = 10.0}));
  const std::vector<float> values{0.5F, 0.0F, 0.0F,    //
                                  0.0F, 0.0F, -2.25F,  //
                                  0.0F, 0.0F, 0.0F};
  const CorrelationVolume volume = correlation_volume(grid, values, {.sensor = sensor, .ranges_m = {1.0F}},
                                                      {.rotation_step_rad = 2.0 * std::numbers::pi});
  EXPECT_NEAR(volume.at(0, {1, 1}), -2.25, 1e-5);
  EXPECT_NEAR(volume.at(0, {0, 0}), 0.0, 1e-5);
  EXPECT_NEAR(volume.at(0, {2, 1}), 0.0, 1e-5);
}

TEST(FftVolume, RefusesWhatDoesNotFit) {
  const GridMap grid = testing::drawn_map({"..", ".."});
  const auto sensor = std::make_shared<const Sensor>(make_fan({.beams = 1, .range_max_m = 10.0}));
  const Scan scan{.sensor = sensor, .ranges_m = {1.0F}};
  EXPECT_THROW(correlation_volume(grid, std::vector<float>(3), scan), Error);
  EXPECT_THROW(correlation_volume(grid, std::vector<float>(4, NAN), scan), Error);
  EXPECT_THROW(correlation_volume(PreparedMap(grid), scan, {.rotation_step_rad = 0.0}), Error);
  EXPECT_THROW((void)time_bare_transforms(4, 3, 1), Error);
}

}  // namespace
}  // namespace landfall
