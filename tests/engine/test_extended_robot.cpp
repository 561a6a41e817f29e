// The minimum filter on drawn sequences, turns as one scan, blur masks.
#include "landfall/extended_robot.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "drawn_map.hpp"
#include "landfall/error.hpp"

namespace landfall {
namespace {

using ::testing::ElementsAre;

constexpr float none = std::numeric_limits<float>::infinity();
constexpr float invalid = std::numeric_limits<float>::quiet_NaN();

std::vector<Scan> turn_of(const std::vector<std::vector<float>>& ranges_m) {
  const auto beams = static_cast<int>(ranges_m.at(0).size());
  const auto sensor =
      std::make_shared<const Sensor>(make_fan({.beams = beams, .step_rad = 0.5, .range_max_m = 9.0}));
  std::vector<Scan> turn;
  turn.reserve(ranges_m.size());
  for (const auto& ranges : ranges_m) turn.push_back({.sensor = sensor, .ranges_m = ranges});
  return turn;
}

// Which readings of one sonar are kept.
std::vector<int> kept_of(const std::vector<float>& ranges_m, bool full_turn = true) {
  std::vector<std::vector<float>> scans;
  scans.reserve(ranges_m.size());
  for (const float range_m : ranges_m) scans.push_back({range_m});
  const std::vector<Scan> filtered = keep_local_minima(turn_of(scans), full_turn);
  std::vector<int> kept;
  for (std::size_t i = 0; i < filtered.size(); ++i) {
    if (std::isnan(filtered[i].ranges_m[0])) continue;
    EXPECT_EQ(filtered[i].ranges_m[0], ranges_m[i]);
    kept.push_back(static_cast<int>(i));
  }
  return kept;
}

TEST(MinimumFilter, KeepsReadingsBelowBothNeighbours) {
  EXPECT_THAT(kept_of({5, 4, 3, 4, 5, 6, 2, 6}), ElementsAre(2, 6));
}

TEST(MinimumFilter, ATurnEndsWhereItBegan) {
  EXPECT_THAT(kept_of({2, 3, 4, 5, 4, 3}), ElementsAre(0));
  EXPECT_THAT(kept_of({3, 4, 5, 4, 3, 2}), ElementsAre(5));
  EXPECT_THAT(kept_of({2, 3, 4, 3, 4}, false), ElementsAre(3));
  EXPECT_THAT(kept_of({2, 3, 4, 5}, false), ElementsAre());
}

TEST(MinimumFilter, KeepsTheMiddleOfAPlateau) {
  EXPECT_THAT(kept_of({5, 3, 3, 3, 5, 6}), ElementsAre(2));
  EXPECT_THAT(kept_of({5, 3, 3, 3, 3, 5, 6}), ElementsAre(2, 3));
  EXPECT_THAT(kept_of({3, 3, 5, 6, 5, 3}), ElementsAre(0));  // over the seam: 5, 0, 1
  EXPECT_THAT(kept_of({6, 3, 3, 2, 6}), ElementsAre(3));     // a step is no minimum
  EXPECT_THAT(kept_of({4, 4, 4, 4}), ElementsAre());
  EXPECT_THAT(kept_of({4, 4, 5, 4, 4}, false), ElementsAre());
}

TEST(MinimumFilter, PassesOverInvalidReadingsAndMissingEchoes) {
  EXPECT_THAT(kept_of({5, invalid, 3, invalid, 5, 6}), ElementsAre(2));
  EXPECT_THAT(kept_of({none, 5, none, none, 8.5F, none}), ElementsAre(1, 4));
  EXPECT_THAT(kept_of({none, 9.5F, none}), ElementsAre());  // beyond the sensor's maximum: no echo
  EXPECT_THAT(kept_of({invalid, invalid}), ElementsAre());
  EXPECT_THAT(kept_of({4}), ElementsAre());
}

TEST(MinimumFilter, LooksAtEachBeamAlone) {
  const std::vector<Scan> kept = keep_local_minima(turn_of({{1, 5}, {2, 4}, {3, 5}}));
  EXPECT_EQ(kept[0].ranges_m[0], 1.0F);
  EXPECT_TRUE(std::isnan(kept[0].ranges_m[1]));
  EXPECT_TRUE(std::isnan(kept[1].ranges_m[0]));
  EXPECT_EQ(kept[1].ranges_m[1], 4.0F);
  EXPECT_TRUE(keep_local_minima({}).empty());
}

TEST(MinimumFilter, RefusesScansOfDifferentSensors) {
  std::vector<Scan> turn = turn_of({{1.0F}, {2.0F}});
  turn[1].sensor = std::make_shared<const Sensor>(make_fan({.beams = 1, .range_max_m = 3.0}));
  EXPECT_THROW((void)keep_local_minima(turn), Error);
}

TEST(MergeTurn, TurnsEachScanByItsShare) {
  const Scan merged = merge_turn(turn_of({{1.0F}, {2.0F}, {3.0F}, {4.0F}}));
  ASSERT_EQ(merged.sensor->beams.size(), 4U);
  EXPECT_THAT(merged.ranges_m, ElementsAre(1.0F, 2.0F, 3.0F, 4.0F));
  EXPECT_NEAR(merged.sensor->beams[0].T_robot_beam.theta_rad, 0.0, 1e-12);
  EXPECT_NEAR(merged.sensor->beams[1].T_robot_beam.theta_rad, std::numbers::pi / 2, 1e-12);
  EXPECT_NEAR(std::abs(merged.sensor->beams[2].T_robot_beam.theta_rad), std::numbers::pi, 1e-12);
}

TEST(RaisedCosineMask, IsOneInTheCentreAndNothingAtTheRim) {
  const std::vector<float> mask = raised_cosine_mask(7);
  ASSERT_EQ(mask.size(), 49U);
  EXPECT_FLOAT_EQ(mask[24], 1.0F);
  EXPECT_FLOAT_EQ(mask[25], 0.75F);  // a third of the way: (1 + cos 60 deg) / 2
  EXPECT_FLOAT_EQ(mask[26], 0.25F);
  EXPECT_EQ(mask[27], 0.0F);
  for (std::size_t i = 0; i < 49; ++i) EXPECT_EQ(mask[i], mask[48 - i]);
  for (std::size_t i = 0; i < 7; ++i) EXPECT_EQ(mask[i], 0.0F);
  for (const int size : {-1, 1, 2, 8, 257}) EXPECT_THROW((void)raised_cosine_mask(size), Error);
}

TEST(BlurredMap, SpreadsWallsAsTheMaskSays) {
  const GridMap grid = testing::drawn_map({".....", ".....", "..#.?"});
  const std::vector<float> mask{0.0F, 1.0F, 0.0F,  //
                                2.0F, 4.0F, 3.0F,  //
                                0.0F, 5.0F, 0.0F};
  EXPECT_THAT(blurred_map(grid, mask), ElementsAre(0, 2, 4, 3, 0, 0, 0, 5, 0, 0, 0, 0, 0, 0, 0));
  EXPECT_THAT(blurred_map(grid, mask, 0), ElementsAre(0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0));
}

// (A blurred) correlated with (W blurred) is A correlated with W blurred twice.
TEST(BlurredMap, TwiceIsBothMapsOnce) {
  GridMap grid = testing::drawn_map(std::vector<std::string>(21, std::string(21, '.')));
  for (const CellIndex wall : {CellIndex{9, 9}, {10, 9}, {12, 11}})
    grid.cells[grid.index(wall)] = Occupancy::occupied;
  const std::vector<float> mask = raised_cosine_mask(5);
  const std::vector<float> once = blurred_map(grid, mask, 1);
  const std::vector<float> twice = blurred_map(grid, mask, 2);
  for (const CellIndex end_point : {CellIndex{9, 9}, {11, 10}, {14, 12}}) {
    double sum = 0.0;
    for (int dy = -2; dy <= 2; ++dy)
      for (int dx = -2; dx <= 2; ++dx)
        sum += static_cast<double>(mask.data()[(dy + 2) * 5 + dx + 2]) *
               static_cast<double>(once[grid.index({end_point.col + dx, end_point.row + dy})]);
    EXPECT_NEAR(twice[grid.index(end_point)], sum, 1e-5);
  }
}

TEST(BlurredMap, RefusesOtherMasks) {
  const GridMap grid = testing::drawn_map({"..", ".."});
  EXPECT_THROW((void)blurred_map(grid, std::vector<float>(4)), Error);
  EXPECT_THROW((void)blurred_map(grid, std::vector<float>(10)), Error);
  EXPECT_THROW((void)blurred_map(grid, std::vector<float>(9), -1), Error);
}

}  // namespace
}  // namespace landfall
