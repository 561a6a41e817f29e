#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "drawing.hpp"
#include "drawn_map.hpp"
#include "engine/mapping/tbf/wall_lines.hpp"
#include "landfall/error.hpp"
#include "landfall/prepared_map.hpp"
#include "landfall/simulate.hpp"
#include "landfall/sonar_mapping.hpp"
#include "sonar_drive.hpp"

namespace landfall {
namespace {

using testing::degree_rad;
using testing::drawing_of;
using testing::drawn_map;
using testing::drive_along;
using testing::sonar_scan;
using testing::sonars;

int count(const GridMap& map, Occupancy kind) {
  return static_cast<int>(std::count(map.cells.begin(), map.cells.end(), kind));
}

// A wall 1 m to the left of a drive of 2 m.
TEST(Tbf, DrawsTheWallThatADriveFollows) {
  const TbfResult result = map_by_triangulation(drive_along(std::vector<float>(41, 1.0f)));
  EXPECT_EQ(result.points.size(), 40U);  // all but the first scan's
  EXPECT_EQ(result.scans.size(), 41U);
  EXPECT_EQ(result.values.size(), result.map.cells.size());
  int on_wall = 0;
  for (int row = 0; row < result.map.height_cells; ++row)
    for (int col = 0; col < result.map.width_cells; ++col) {
      if (result.map.at({.col = col, .row = row}) != Occupancy::occupied) continue;
      const Point2 p = result.map.center_of({.col = col, .row = row});
      EXPECT_NEAR(p.y_m, 1.0, 0.1);
      EXPECT_NEAR(p.x_m, 1.0, 1.2);
      ++on_wall;
    }
  EXPECT_GT(on_wall, 30);
  for (double x_m = 0.1; x_m < 2.0; x_m += 0.1)
    for (double y_m = 0.0; y_m < 0.85; y_m += 0.1)
      EXPECT_EQ(result.map.at(result.map.cell_of({x_m, y_m})), Occupancy::free) << x_m << ' ' << y_m;
}

TEST(Tbf, TriangulationsCountThePartnersOfEachReading) {
  const TbfResult result = map_by_triangulation(drive_along(std::vector<float>(6, 1.0f)));
  ASSERT_EQ(result.points.size(), 5U);
  for (std::size_t i = 0; i < result.points.size(); ++i) {
    EXPECT_EQ(result.points[i].triangulations, static_cast<int>(i + 1));
    EXPECT_EQ(result.points[i].scan, i + 1);
    EXPECT_EQ(result.points[i].beam, 0U);
    // On the wall, but for the arcs' bulge, and about half-way between the sonars that saw it.
    EXPECT_NEAR(result.points[i].p_map.y_m, 1.0, 0.01);
    EXPECT_NEAR(result.points[i].p_map.x_m, 0.025 * static_cast<double>(i + 1), 0.01);
  }
}

TEST(Tbf, AWindowOfOneScanFindsNothing) {
  const std::vector<Scan> scans = drive_along(std::vector<float>(41, 1.0f));
  const TbfResult result = map_by_triangulation(scans, {.window_scans = 1});
  EXPECT_TRUE(result.points.empty());
  EXPECT_EQ(count(result.map, Occupancy::occupied), 0);
  EXPECT_EQ(map_by_triangulation(scans, {.window_scans = 2}).points.size(), 40U);
}

TEST(Tbf, ReadingsWithoutPartnersLeaveNoTrace) {
  std::vector<float> ranges_m(41, 1.0f);
  ranges_m[20] = 2.0f;  // an outlier: no arc crosses its own
  const TbfResult clean = map_by_triangulation(drive_along(std::vector<float>(41, 1.0f)), {.margin_m = 3.0});
  const TbfResult result = map_by_triangulation(drive_along(ranges_m), {.margin_m = 3.0});
  EXPECT_EQ(result.points.size(), clean.points.size() - 1);
  int beyond = 0;
  for (int row = 0; row < result.map.height_cells; ++row)
    for (int col = 0; col < result.map.width_cells; ++col) {
      const CellIndex cell{.col = col, .row = row};
      beyond += result.map.center_of(cell).y_m > 1.1 && result.map.at(cell) != Occupancy::unknown;
    }
  EXPECT_EQ(beyond, 0);
}

TEST(Tbf, ReadingsOfNoEchoOrInvalidOnesTriangulateNothing) {
  constexpr float nan = std::numeric_limits<float>::quiet_NaN();
  constexpr float infinity = std::numeric_limits<float>::infinity();
  for (const float range_m : {5.0f, 7.0f, infinity, nan, 0.0f, -1.0f}) {
    const TbfResult result = map_by_triangulation(drive_along(std::vector<float>(10, range_m)));
    EXPECT_TRUE(result.points.empty()) << range_m;
    EXPECT_EQ(count(result.map, Occupancy::occupied), 0) << range_m;
  }
  // Between echoes they are passed over: the same points from the scans that have one.
  std::vector<float> some(20, 1.0f);
  some[7] = 5.0f;
  some[8] = nan;
  const TbfResult result = map_by_triangulation(drive_along(some));
  // Arcs of 1 m and 25 degrees cross up to 2 sin(12.5 degrees) = 0.43 m apart: eight scans.
  ASSERT_EQ(result.points.size(), 17U);
  EXPECT_EQ(result.points[9].triangulations, 6);  // of scan 12: scans 4 to 11 but for 7 and 8
  EXPECT_EQ(result.points.back().triangulations, 8);
}

TEST(Tbf, SomeoneWhoWentIsErased) {
  // Something at 0.72 m for a while; then the same stretch is driven again, and there is only the wall.
  std::vector<Scan> scans;
  for (const float range_m : {0.72f, 1.02f, 1.02f, 1.02f})
    for (const Scan& scan : drive_along(std::vector<float>(30, range_m))) scans.push_back(scan);
  const auto occupied_near = [](const GridMap& map, double y_m) {
    int cells = 0;
    for (double x_m = 0.4; x_m < 1.2; x_m += 0.05)
      for (double off_m = -0.05; off_m < 0.06; off_m += 0.05)
        cells += map.at(map.cell_of({x_m, y_m + off_m})) == Occupancy::occupied;
    return cells;
  };
  const std::vector<Scan> first(scans.begin(), scans.begin() + 30);
  EXPECT_GT(occupied_near(map_by_triangulation(first, {.window_scans = 30}).map, 0.72), 10);
  const GridMap map = map_by_triangulation(scans, {.window_scans = 30}).map;
  EXPECT_EQ(occupied_near(map, 0.72), 0);
  EXPECT_GT(occupied_near(map, 1.02), 10);
}

// Robot in the middle of a corridor 2 m wide; the sonars of a Pioneer's directions.
const std::vector<double> ring_deg = {90,  50,   30,   10,   -10, -30, -50, -90,
                                      -90, -130, -150, -170, 170, 150, 130, 90};

// What exact cones see in a drawn corridor.
std::vector<float> seen_in(const GridMap& map, const Pose2& T_map_robot) {
  return simulate_ranges(PreparedMap(map), *sonars(ring_deg), std::vector<Pose2>{T_map_robot});
}

const std::vector<std::string> corridor = {"##########",  //
                                           "#........#",  //
                                           "#........#",  //
                                           "#........#",  //
                                           "#........#",  //
                                           "##########"};

TEST(BoundingBoxes, ShortenReadingsThatPassTheWalls) {
  // Cells of 0.5 m: the corridor is 4 x 2 m inside; 2.5 m to the front, 1.5 m to the back, 1 m to each side.
  const GridMap map = drawn_map(corridor, 0.5);
  const Pose2 T_map_robot{2.0, 1.5, 0.0};
  std::vector<float> ranges_m = seen_in(map, T_map_robot);
  const Scan honest = sonar_scan(sonars(ring_deg), T_map_robot, ranges_m);
  EXPECT_EQ(correct_to_bounding_box(honest).ranges_m, ranges_m);
  ranges_m[1] = 4.0f;   // 50 degrees: specular
  ranges_m[10] = 4.5f;  // -150 degrees
  ranges_m[5] = 5.0f;   // -30 degrees: no echo
  ranges_m[13] = 0.4f;  // someone walking by
  const Scan corrected = correct_to_bounding_box(sonar_scan(sonars(ring_deg), T_map_robot, ranges_m));
  EXPECT_NEAR(corrected.ranges_m[1], 1.0 / std::sin(50.0 * degree_rad), 1e-5);
  EXPECT_NEAR(corrected.ranges_m[10], 1.5 / std::cos(30.0 * degree_rad), 1e-5);
  EXPECT_NEAR(corrected.ranges_m[5], 1.0 / std::sin(30.0 * degree_rad), 1e-5);
  EXPECT_EQ(corrected.ranges_m[13], 0.4f);
  EXPECT_EQ(correct_to_bounding_box(honest).T_map_robot, honest.T_map_robot);
  const Scan kept = correct_to_bounding_box(sonar_scan(sonars(ring_deg), T_map_robot, ranges_m), false);
  EXPECT_EQ(kept.ranges_m[5], 5.0f);
}

TEST(BoundingBoxes, AreOpenWhereADoorIs) {
  // The upper wall has a door beside the robot: its left side is as far as the room's wall, 3 m.
  const GridMap map = drawn_map({"##########",  //
                                 "#........#",  //
                                 "#........#",  //
                                 "#........#",  //
                                 "##......##",  //
                                 "#........#",  //
                                 "#........#",  //
                                 "#........#",  //
                                 "#........#",  //
                                 "##########"},
                                0.5);
  const Pose2 T_map_robot{2.5, 1.5, 0.0};
  std::vector<float> ranges_m = seen_in(map, T_map_robot);
  ranges_m[1] = 2.8f;  // 50 degrees, through the door: 2.1 m to the left
  ranges_m[6] = 2.8f;  // -50 degrees: the wall on the right is whole
  const Scan corrected = correct_to_bounding_box(sonar_scan(sonars(ring_deg), T_map_robot, ranges_m));
  EXPECT_EQ(corrected.ranges_m[1], 2.8f);
  EXPECT_NEAR(corrected.ranges_m[6], 1.0 / std::sin(50.0 * degree_rad), 1e-5);
}

TEST(BoundingBoxes, OfAPairTheFartherCountsAndBothMustHaveAnEcho) {
  std::vector<float> ranges_m(ring_deg.size(), 4.9f);
  ranges_m[0] = 1.0f;   // left
  ranges_m[15] = 1.2f;  // left, too
  ranges_m[7] = 1.0f;   // right
  ranges_m[8] = 5.0f;   // right: nothing
  const Scan corrected = correct_to_bounding_box(sonar_scan(sonars(ring_deg), {}, ranges_m));
  EXPECT_NEAR(corrected.ranges_m[1], 1.2 / std::sin(50.0 * degree_rad), 1e-5);
  EXPECT_EQ(corrected.ranges_m[6], 4.9f);
}

TEST(BoundingBoxes, StartFromTheSonarsOwnPlace) {
  Sensor sensor{.name = "two", .beams = {}};
  sensor.beams.push_back(
      {.T_robot_beam = {0.1, 0.2, 90.0 * degree_rad}, .half_angle_rad = 0.2, .range_max_m = 5.0});
  sensor.beams.push_back(
      {.T_robot_beam = {0.2, 0.1, 45.0 * degree_rad}, .half_angle_rad = 0.2, .range_max_m = 5.0});
  // The wall is 1.2 m left of the robot's centre, 1.1 m left of the second sonar.
  const Scan corrected = correct_to_bounding_box(
      sonar_scan(std::make_shared<const Sensor>(sensor), {3.0, 4.0, 1.0}, {1.0f, 3.0f}));
  EXPECT_NEAR(corrected.ranges_m[1], 1.1 * std::sqrt(2.0), 1e-5);
}

TEST(Tbf, WithTheBoxNoEchoBecomesAWall) {
  // A side sonar with echoes, and one at 50 degrees that hears nothing: its target is the side's wall.
  const auto sensor = sonars({90.0, 50.0});
  std::vector<Scan> scans;
  scans.reserve(60);
  for (int i = 0; i < 60; ++i) scans.push_back(sonar_scan(sensor, {0.05 * i, 0.0, 0.0}, {1.0f, 5.0f}));
  const TbfResult plain = map_by_triangulation(scans);
  const TbfResult box = map_by_triangulation(scans, {.bounding_box = true});
  const TbfResult echoes_alone =
      map_by_triangulation(scans, {.bounding_box = true, .box_corrects_no_echo = false});
  EXPECT_EQ(echoes_alone.map, plain.map);
  EXPECT_EQ(plain.points.back().triangulations, 8);
  EXPECT_GT(box.points.back().triangulations, 8);
  EXPECT_NEAR(box.scans[0].ranges_m[1], 1.0 / std::sin(50.0 * degree_rad), 1e-5);
  EXPECT_EQ(plain.scans[0].ranges_m[1], 5.0f);
}

std::vector<std::string> connected(const std::vector<std::string>& lines,
                                   const std::vector<std::string>& passed_lines, const TbfOptions& options) {
  GridMap map = drawn_map(lines, 0.1);
  std::vector<std::uint8_t> passed;
  for (const Occupancy cell : drawn_map(passed_lines, 0.1).cells)
    passed.push_back(cell == Occupancy::free ? 1 : 0);
  internal::connect_walls(map, passed, options);
  return drawing_of(map);
}

TEST(WallLines, ConnectWhatLinesUpAndDropTheRest) {
  const TbfOptions options{.wall_gap_m = 0.4, .wall_length_m = 0.5};
  const std::vector<std::string> unpassed(5, std::string(24, '?'));
  EXPECT_EQ(connected({"????????????????????????",  //
                       "??#####???######?????###",  //
                       "........................",  //
                       ".....#..............#...",  //
                       "........................"},
                      unpassed, options),
            (std::vector<std::string>{"????????????????????????",  //
                                      "??##############?????###",  //
                                      "........................",  //
                                      "........................",  //
                                      "........................"}));
}

TEST(WallLines, LeaveOpenWhatReadingsPassed) {
  const TbfOptions options{.wall_gap_m = 0.4, .wall_length_m = 0.5};
  const std::vector<std::string> wall = {"????????????????", "?######???#####?", "................"};
  const std::vector<std::string> door = {"????????????????", "???????...??????", "................"};
  EXPECT_EQ(connected(wall, door, options), wall);
  EXPECT_EQ(connected({"????????", "??##?#??", "........"}, std::vector<std::string>(3, "????????"), options),
            (std::vector<std::string>{"????????", "??..?.??", "........"}));  // too short for a wall
}

TEST(Tbf, ConnectsWallsAndKeepsWhatWasMeasured) {
  std::vector<float> ranges_m(60, 1.0f);
  for (std::size_t i = 25; i < 35; ++i) ranges_m[i] = 5.0f;
  const TbfResult plain = map_by_triangulation(drive_along(ranges_m));
  const TbfResult lined_up =
      map_by_triangulation(drive_along(ranges_m), {.connect_walls = true, .wall_gap_m = 1.0});
  EXPECT_EQ(lined_up.values, plain.values);
  EXPECT_GT(count(lined_up.map, Occupancy::occupied), count(plain.map, Occupancy::occupied));
  EXPECT_EQ(lined_up.map.at(lined_up.map.cell_of({1.5, 0.99})), Occupancy::occupied);
  EXPECT_NE(plain.map.at(plain.map.cell_of({1.5, 0.99})), Occupancy::occupied);
}

TEST(Tbf, RefusesWhatItCannotFuse) {
  const auto message_of = [](const std::vector<Scan>& scans, const TbfOptions& options) -> std::string {
    try {
      map_by_triangulation(scans, options);
    } catch (const Error& error) {
      return std::string(to_string(error.code())) + ": " + error.what();
    }
    return "";
  };
  const std::vector<Scan> good = drive_along({1.0f, 1.0f});
  std::vector<Scan> lost = good;
  lost[1].T_map_robot.reset();
  Sensor laser = *good[0].sensor;
  laser.beams[0].half_angle_rad = 0.0;
  const Scan by_laser = sonar_scan(std::make_shared<const Sensor>(laser), {}, {1.0f});
  const auto has = [](const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
  };
  EXPECT_EQ(message_of(good, {}), "");
  EXPECT_TRUE(has(message_of({}, {}), "no scans"));
  EXPECT_TRUE(has(message_of(lost, {}), "scan 1 has no T_map_robot"));
  EXPECT_TRUE(has(message_of({by_laser}, {}), "half_angle_rad is 0"));
  EXPECT_TRUE(has(message_of(good, {.window_scans = 0}), "window_scans"));
  EXPECT_TRUE(has(message_of(good, {.max_deviation_m = 0.0}), "max_deviation_m"));
  EXPECT_TRUE(has(message_of(good, {.scale_m2 = -1.0}), "scale_m2"));
  EXPECT_TRUE(has(message_of(good, {.occupied_value = 1.5}), "occupied_value"));
  EXPECT_TRUE(has(message_of(good, {.resolution_m = 0.0}), "resolution_m"));
}

}  // namespace
}  // namespace landfall
