// Correlation by transforms against direct sums: with the library that the build names, and once more with
// Eigen's transforms in an executable of its own.
#include "engine/methods/fft/correlator.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>

#include "naive_correlation.hpp"
#include "random_world.hpp"

namespace landfall {
namespace {

using internal::CorrelationTiles;
using internal::Correlator;
using internal::HeadingCells;
using internal::MapSpectra;
using testing::Dice;
using testing::Field;

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

TEST(Correlator, EqualsDirectSumsOnRandomSizes) {
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

TEST(Correlator, EqualsDirectSumsInOverlappingTiles) {
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
TEST(Correlator, ErrorBoundHoldsForConstantFields) {
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
TEST(Correlator, NothingWrapsAroundTheEdge) {
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

}  // namespace
}  // namespace landfall
