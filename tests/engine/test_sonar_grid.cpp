#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "landfall/error.hpp"
#include "landfall/sonar_mapping.hpp"
#include "sonar_drive.hpp"

namespace landfall {
namespace {

using testing::drive_along;
using testing::sonar_scan;
using testing::sonars;

std::vector<Scan> repeated(const Scan& scan, std::size_t times) {
  return std::vector<Scan>(times, scan);
}

Occupancy at(const GridMap& map, double range_m, double off_deg) {
  const double off_rad = off_deg * testing::degree_rad;
  return map.at(map.cell_of({range_m * std::cos(off_rad), range_m * std::sin(off_rad)}));
}

// One sonar along x that reads 2 m, often enough.
TEST(SonarGrids, AConeIsFreeAndItsArcOccupied) {
  const GridMap map = map_from_sonars(repeated(sonar_scan(sonars({0.0}), {}, {2.0f}), 40));
  EXPECT_EQ(at(map, 2.0, 0.0), Occupancy::occupied);
  EXPECT_EQ(at(map, 2.0, 8.0), Occupancy::occupied);
  EXPECT_EQ(at(map, 2.0, -8.0), Occupancy::occupied);
  EXPECT_EQ(at(map, 1.0, 0.0), Occupancy::free);
  EXPECT_EQ(at(map, 0.5, 5.0), Occupancy::free);
  EXPECT_EQ(at(map, 2.0, 15.0), Occupancy::unknown);  // beside the cone
  EXPECT_EQ(at(map, 1.0, 20.0), Occupancy::unknown);
  EXPECT_EQ(at(map, 2.3, 0.0), Occupancy::unknown);  // behind the arc: 3 (0.01 + 0.01 * 2) = 0.09 m
}

// The middle of an arc of one cell: 0.5 + 0.4 and log(0.9 / 0.1) = 2.2; twice is 4.4, bounded to 3.5.
TEST(SonarGrids, LogOddsAreTheProfiles) {
  // A beam so narrow that its arc is within a cell, the arc's middle on the cell's centre.
  Sensor narrow{.name = "narrow", .beams = {}, .range_noise_m = 0.001};
  narrow.beams.push_back({.T_robot_beam = {}, .half_angle_rad = 0.01, .range_max_m = 5.0});
  const Scan scan = sonar_scan(std::make_shared<const Sensor>(narrow), {0.525, 0.525, 0.0}, {1.0f});
  const auto occupied_at = [&](std::size_t times, double occupied_log_odds) {
    const GridMap map = map_from_sonars(repeated(scan, times), {.occupied_log_odds = occupied_log_odds});
    return map.at(map.cell_of({1.525, 0.525})) == Occupancy::occupied;
  };
  EXPECT_TRUE(occupied_at(1, 2.19));
  EXPECT_FALSE(occupied_at(1, 2.20));
  EXPECT_TRUE(occupied_at(2, 3.49));
  EXPECT_FALSE(occupied_at(2, 3.51));
}

TEST(SonarGrids, LongArcsSayLessOfEachCell) {
  const auto occupied_after = [](float range_m, std::size_t times) {
    return at(map_from_sonars(repeated(sonar_scan(sonars({0.0}), {0.0, 0.025, 0.0}, {range_m}), times)),
              range_m, 0.0) == Occupancy::occupied;
  };
  EXPECT_TRUE(occupied_after(0.525f, 2));
  EXPECT_FALSE(occupied_after(4.025f, 2));
  EXPECT_TRUE(occupied_after(4.025f, 12));
}

TEST(SonarGrids, WithoutEchoNothingIsSaid) {
  const GridMap map = map_from_sonars(drive_along(std::vector<float>(10, 5.0f)));
  for (const Occupancy cell : map.cells) EXPECT_EQ(cell, Occupancy::unknown);
}

TEST(EndPointMaps, OneEchoOccupiesForGood) {
  std::vector<Scan> scans = drive_along({1.0f}, 0.0);
  for (int i = 0; i < 50; ++i) scans.push_back(drive_along({2.0f}, 0.0)[0]);
  const GridMap map = map_of_end_points(scans);
  EXPECT_EQ(map.at(map.cell_of({0.0, 1.0})), Occupancy::occupied);
  EXPECT_EQ(map.at(map.cell_of({0.0, 2.0})), Occupancy::occupied);
  EXPECT_EQ(map.at(map.cell_of({0.0, 1.5})), Occupancy::free);
  EXPECT_EQ(map.at(map.cell_of({0.2, 1.5})), Occupancy::unknown);
}

TEST(SonarGrids, RefuseWhatTheyCannotMap) {
  const auto code_of = [](const std::vector<Scan>& scans, const SonarGridOptions& options) {
    try {
      map_from_sonars(scans, options);
    } catch (const Error& error) {
      return error.code();
    }
    return ErrorCode::file_write;  // none of those expected
  };
  const std::vector<Scan> good = drive_along({1.0f});
  EXPECT_EQ(code_of(good, {}), ErrorCode::file_write);
  EXPECT_EQ(code_of({}, {}), ErrorCode::invalid_argument);
  EXPECT_EQ(code_of(good, {.occupied_weight = 0.5}), ErrorCode::invalid_argument);
  EXPECT_EQ(code_of(good, {.empty_weight = -0.1}), ErrorCode::invalid_argument);
  EXPECT_EQ(code_of(good, {.max_log_odds = 0.0}), ErrorCode::invalid_argument);
  EXPECT_EQ(code_of(good, {.resolution_m = -1.0}), ErrorCode::invalid_argument);
  EXPECT_THROW(map_of_end_points({}), Error);
}

}  // namespace
}  // namespace landfall
