// The whole volume of scores against direct sums.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "drawn_map.hpp"
#include "engine/methods/fft/bare_transforms.hpp"
#include "landfall/correlation.hpp"
#include "landfall/error.hpp"
#include "landfall/search.hpp"
#include "naive_correlation.hpp"
#include "rooms.hpp"

namespace landfall {
namespace {

using internal::HeadingCells;
using testing::Field;

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

// What search() streams, heading by heading, and the volume that is stored.
TEST(FftVolume, ItsMaximumIsTheStreamedOne) {
  const PreparedMap map(testing::furnished_room({1.0, 2.0, 0.3}));
  const double step_rad = 2.0 * std::numbers::pi / 36;
  for (const double theta_rad : {0.0, 1.1, -2.5}) {
    SCOPED_TRACE(theta_rad);
    const Scan scan = testing::look(map, testing::full_circle(60), {4.0, 4.0, theta_rad});
    const CorrelationVolume volume = correlation_volume(map, scan, {.rotation_step_rad = step_rad});
    float most = 0.0F;
    for (int heading = 0; heading < volume.headings; ++heading)
      for (int row = 0; row < volume.height_cells; ++row)
        for (int col = 0; col < volume.width_cells; ++col)
          if (map.grid().at({col, row}) == Occupancy::free)
            most = std::max(most, volume.at(heading, {col, row}));
    const SearchResult streamed =
        search(map, {Anywhere{}}, scan, {.method = "fft", .rotation_step_rad = step_rad});
    std::int64_t best = 0;
    for (const Hypothesis& hypothesis : streamed.hypotheses)
      best = std::max<std::int64_t>(best, hypothesis.score);
    EXPECT_EQ(std::lround(most), best);
    EXPECT_GT(best, 0);
  }
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
  EXPECT_THROW(internal::BareTransforms(4, 3), Error);
}

}  // namespace
}  // namespace landfall
