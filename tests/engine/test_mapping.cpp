#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "data_folder.hpp"
#include "drawing.hpp"
#include "drawn_map.hpp"
#include "landfall/error.hpp"
#include "landfall/io.hpp"
#include "landfall/mapping.hpp"
#include "landfall/simulate.hpp"

namespace landfall {
namespace {

using testing::drawing_of;

constexpr double pi = std::numbers::pi;

// A scan from (x, y) with one beam along x for each range.
Scan forward_scan(double x_m, double y_m, const std::vector<float>& ranges_m) {
  Sensor sensor{.name = "forward", .beams = {}};
  sensor.beams.resize(ranges_m.size());
  return {.sensor = std::make_shared<const Sensor>(sensor),
          .ranges_m = ranges_m,
          .T_map_robot = Pose2{x_m, y_m, 0.0}};
}

// Cells of 1 m; one scan decides: hit 0.85 >= 0.4, miss -0.4 <= -0.2.
constexpr MappingOptions one_metre{.resolution_m = 1.0, .margin_m = 0.0};

TEST(Mapping, ABeamFreesItsWayAndOccupiesItsEnd) {
  const std::vector<Scan> scans{forward_scan(0.5, 0.5, {3.0f})};
  EXPECT_EQ(drawing_of(map_from_known_poses(scans, one_metre)), (std::vector<std::string>{"...#"}));
}

TEST(Mapping, LeavesTheMarginUnknown) {
  MappingOptions options = one_metre;
  options.margin_m = 1.0;
  const std::vector<Scan> scans{forward_scan(0.5, 0.5, {1.0f})};
  const GridMap map = map_from_known_poses(scans, options);
  EXPECT_EQ(drawing_of(map), (std::vector<std::string>{"????", "?.#?", "????"}));
  EXPECT_EQ(map.T_map_grid, (Pose2{-1.0, -1.0, 0.0}));
}

TEST(Mapping, WithoutEchoNothingIsFreed) {
  constexpr float nan = std::numeric_limits<float>::quiet_NaN();
  const std::vector<Scan> scans{forward_scan(0.5, 0.5, {nan, 80.0f, 2.0f})};
  EXPECT_EQ(drawing_of(map_from_known_poses(scans, one_metre)), (std::vector<std::string>{"..#"}));
  EXPECT_EQ(drawing_of(map_from_known_poses(std::vector{forward_scan(0.5, 0.5, {nan, 80.0f})}, one_metre)),
            (std::vector<std::string>{"?"}));
}

TEST(Mapping, ACellCountsOnceAScanAndAHitWins) {
  // Nine beams pass the cell in which one ends: within a scan it is hit; cells passed are missed once.
  std::vector<float> ranges_m(9, 4.0f);
  ranges_m.push_back(2.0f);
  MappingOptions options = one_metre;
  options.free_log_odds = -0.5;  // one miss (-0.4) is not enough, two are
  EXPECT_EQ(drawing_of(map_from_known_poses(std::vector{forward_scan(0.5, 0.5, ranges_m)}, options)),
            (std::vector<std::string>{"??#?#"}));
  const std::vector<Scan> twice{forward_scan(0.5, 0.5, ranges_m), forward_scan(0.5, 0.5, ranges_m)};
  EXPECT_EQ(drawing_of(map_from_known_poses(twice, options)), (std::vector<std::string>{"..#.#"}));
}

TEST(Mapping, ManyMissesOutweighAHitThatMoved) {
  // Someone stood in the third cell once: 0.85 - 3 * 0.4 = -0.35.
  const std::vector<Scan> scans{forward_scan(0.5, 0.5, {2.0f}), forward_scan(0.5, 0.5, {3.0f}),
                                forward_scan(0.5, 0.5, {3.0f}), forward_scan(0.5, 0.5, {3.0f})};
  EXPECT_EQ(drawing_of(map_from_known_poses(scans, one_metre)), (std::vector<std::string>{"...#"}));
}

TEST(Mapping, EvidenceIsBounded) {
  // A hundred hits stop at 3.5; ten misses (-4.0) then turn the cell to -0.5.
  std::vector<Scan> scans(100, forward_scan(0.5, 0.5, {2.0f}));
  scans.insert(scans.end(), 10, forward_scan(0.5, 0.5, {3.0f}));
  EXPECT_EQ(drawing_of(map_from_known_poses(scans, one_metre)), (std::vector<std::string>{"...#"}));
}

TEST(Mapping, AnEchoBeyondTheLimitFreesTheLimitAlone) {
  MappingOptions options = one_metre;
  options.range_max_m = 2.0;
  EXPECT_EQ(drawing_of(map_from_known_poses(std::vector{forward_scan(0.5, 0.5, {9.0f})}, options)),
            (std::vector<std::string>{"..?"}));
}

TEST(Mapping, UsesTheMountOfEachBeam) {
  // Robot at (2.5, 0.5) facing up; the beam is mounted 1 m ahead and points back past the robot's left.
  Scan scan = forward_scan(2.5, 0.5, {2.0f});
  scan.sensor = std::make_shared<const Sensor>(
      Sensor{.name = "left", .beams = {Beam{.T_robot_beam = {1.0, 0.0, pi / 2}}}});
  scan.T_map_robot->theta_rad = pi / 2;
  EXPECT_EQ(drawing_of(map_from_known_poses(std::vector{scan}, one_metre)),
            (std::vector<std::string>{"#..", "???"}));
}

TEST(Mapping, BringsBackTheRoomThatWasSimulated) {
  const GridMap room = testing::drawn_map({"##########",  //
                                           "#........#",  //
                                           "#..##....#",  //
                                           "#..##....#",  //
                                           "#......#.#",  //
                                           "##########"},
                                          0.5);
  const auto sensor = std::make_shared<const Sensor>(
      make_fan({.name = "laser", .beams = 360, .first_rad = 0.0, .step_rad = pi / 180.0}));
  const std::vector<Pose2> poses{
      {0.75, 0.75, 0.003}, {0.75, 2.25, 1.0}, {4.2, 2.2, 2.0}, {4.2, 0.8, 3.0}, {2.7, 0.8, 0.0}};
  std::vector<Scan> scans = simulate(PreparedMap(room), sensor, poses, {.noise = false});
  for (Scan& scan : scans)
    for (float& range_m : scan.ranges_m) range_m += 0.001f;  // into the cell whose face was hit
  MappingOptions options;
  options.resolution_m = 0.5;
  options.margin_m = 0.0;
  // Corners, and the cell under the post, have no face that can be seen.
  EXPECT_EQ(drawing_of(map_from_known_poses(scans, options)), (std::vector<std::string>{"?########?",  //
                                                                                        "#........#",  //
                                                                                        "#..##....#",  //
                                                                                        "#..##....#",  //
                                                                                        "#......#.#",  //
                                                                                        "?######?#?"}));
}

// The share of `from`'s cells of this kind for which `to` has one at most `reach` cells away.
double share_found(const GridMap& from, const GridMap& to, Occupancy kind, int reach) {
  int cells = 0;
  int found = 0;
  for (int row = 0; row < from.height_cells; ++row)
    for (int col = 0; col < from.width_cells; ++col) {
      if (from.at({.col = col, .row = row}) != kind) continue;
      ++cells;
      const CellIndex same = to.cell_of(from.center_of({.col = col, .row = row}));
      bool near = false;
      for (int d = 0; d < (2 * reach + 1) * (2 * reach + 1); ++d)
        near = near || to.at({.col = same.col - reach + d % (2 * reach + 1),
                              .row = same.row - reach + d / (2 * reach + 1)}) == kind;
      found += near;
    }
  return static_cast<double>(found) / cells;
}

// The map beside the log was made by others from the same poses; it keeps fainter walls.
TEST(Mapping, AgreesWithTheMapThatComesWithARealLog) {
  LANDFALL_REQUIRE_DATA();
  const auto folder = testing::data_folder() / "intel";
  const GridMap reference = load_grid_map(folder / "map.yaml");
  const GridMap mapped = map_from_known_poses(load_log(folder / "map.log.gz").scans);
  EXPECT_GT(share_found(reference, mapped, Occupancy::free, 0), 0.999);
  EXPECT_GT(share_found(mapped, reference, Occupancy::occupied, 1), 0.995);
  EXPECT_GT(share_found(reference, mapped, Occupancy::occupied, 1), 0.95);
}

TEST(Mapping, RefusesWhatItCannotMap) {
  const auto code_of = [](const std::vector<Scan>& scans, const MappingOptions& options) {
    try {
      map_from_known_poses(scans, options);
    } catch (const Error& error) {
      return error.code();
    }
    return ErrorCode::file_write;  // none of those expected
  };
  const Scan good = forward_scan(0.0, 0.0, {1.0f});
  Scan lost = good;
  lost.T_map_robot.reset();
  Scan far = good;
  far.T_map_robot->x_m = 1e9;
  EXPECT_EQ(code_of({}, {}), ErrorCode::invalid_argument);
  EXPECT_EQ(code_of({good, lost}, {}), ErrorCode::invalid_argument);
  EXPECT_EQ(code_of({good}, {.resolution_m = 0.0}), ErrorCode::invalid_argument);
  EXPECT_EQ(code_of({good}, {.log_odds_miss = 0.1}), ErrorCode::invalid_argument);
  EXPECT_EQ(code_of({good, far}, {}), ErrorCode::too_large);
}

}  // namespace
}  // namespace landfall
