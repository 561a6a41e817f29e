#include "engine/verify/verify.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "rooms.hpp"

namespace landfall {
namespace {

using internal::Verification;
constexpr double pi = std::numbers::pi;
constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr float invalid = std::numeric_limits<float>::quiet_NaN();

// 4.8 m between the faces of its walls, which stand at 0.1 and 4.9.
const GridMap room = testing::empty_room(50, 50, 0.1);
const Pose2 middle{2.5, 2.5, 0.0};

std::shared_ptr<const Sensor> four_beams(const Pose2& T_robot_sensor = {}) {
  return std::make_shared<const Sensor>(make_fan({.beams = 4,
                                                  .first_rad = 0.0,
                                                  .step_rad = pi / 2,
                                                  .T_robot_sensor = T_robot_sensor,
                                                  .range_max_m = 10.0}));
}

Verification verify(const GridMap& grid, const Scan& scan, const Pose2& T_map_robot) {
  const PreparedMap map(grid);
  return internal::verify(map.state(), scan, std::vector<Pose2>{T_map_robot}).front();
}

// Forward, left, backward, right from the middle of the room: 2.4 m each.
Verification verify_ranges(const std::vector<float>& ranges_m, const GridMap& grid = room) {
  return verify(grid, {.sensor = four_beams(), .ranges_m = ranges_m}, middle);
}

void expect_shares(const Verification& actual, double explained, double blocked, double seen_through) {
  EXPECT_DOUBLE_EQ(actual.explained, explained);
  EXPECT_DOUBLE_EQ(actual.blocked, blocked);
  EXPECT_DOUBLE_EQ(actual.seen_through, seen_through);
}

// Tolerance: three sigma of 1 cm and two cells of 10 cm.
TEST(Verify, CountsBeamsByWhereTheyEnd) {
  expect_shares(verify_ranges({2.4F, 2.4F, 2.4F, 2.4F}), 1.0, 0.0, 0.0);
  expect_shares(verify_ranges({2.6F, 2.2F, 2.4F, 2.4F}), 1.0, 0.0, 0.0);
  expect_shares(verify_ranges({2.1F, 2.4F, 2.4F, 2.4F}), 0.75, 0.25, 0.0);
  expect_shares(verify_ranges({2.8F, 2.4F, 2.4F, 2.4F}), 0.75, 0.0,
                0.0);  // behind the wall, but not well behind
  expect_shares(verify_ranges({3.1F, 1.0F, 5.0F, 2.4F}), 0.25, 0.25, 0.5);
}

TEST(Verify, SharesAreOfValidBeams) {
  expect_shares(verify_ranges({2.4F, invalid, -1.0F, 1.0F}), 0.5, 0.5, 0.0);
  expect_shares(verify_ranges({invalid, invalid, invalid, invalid}), 0.0, 0.0, 0.0);
}

TEST(Verify, NothingHitIsExplainedWhereTheMapIsOpen) {
  GridMap open = room;
  testing::fill(open, {49, 20}, {49, 30}, Occupancy::free);  // a door ahead
  for (const float nothing_hit : {10.0F, 11.0F, infinity}) {
    expect_shares(verify_ranges({nothing_hit, 2.4F, 2.4F, 2.4F}, open), 1.0, 0.0, 0.0);
    expect_shares(verify_ranges({2.4F, nothing_hit, 2.4F, 2.4F}, open), 0.5, 0.25,
                  0.0);  // an echo in the door
  }
}

TEST(Verify, UnknownExplainsNothing) {
  GridMap unseen = room;
  testing::fill(unseen, {49, 0}, {49, 49}, Occupancy::unknown);
  expect_shares(verify_ranges({2.4F, 2.4F, 2.4F, 2.4F}, unseen), 0.75, 0.25, 0.0);
}

TEST(Verify, BeamsStartAtTheirMount) {
  const Scan scan{.sensor = four_beams({1.0, 0.0, 0.0}), .ranges_m = {1.4F, 2.4F, 3.4F, 2.4F}};
  expect_shares(verify(room, scan, middle), 1.0, 0.0, 0.0);
  expect_shares(verify(room, scan, {2.5, 2.5, pi / 2}), 1.0, 0.0, 0.0);  // the room is square
  expect_shares(verify(room, scan, {2.0, 2.5, 0.0}), 0.5, 0.25, 0.0);    // 1.9 ahead, 2.9 behind
}

// A pillar's edge between two beams, 2 m ahead of a wall at 3.9 m; each measured what the other should have.
TEST(Verify, ANeighboursRangeExplainsABeamAtAnEdge) {
  GridMap with_pillar = room;
  testing::fill(with_pillar, {30, 25}, {32, 30}, Occupancy::occupied);
  const auto two_beams = [](double apart_rad) {
    return Scan{.sensor = std::make_shared<const Sensor>(make_fan(
                    {.beams = 2, .first_rad = -apart_rad / 2, .step_rad = apart_rad, .range_max_m = 10.0})),
                .ranges_m = {2.0F, 3.9F}};
  };
  expect_shares(verify(with_pillar, two_beams(0.02), {1.0, 2.5, 0.0}), 1.0, 0.0, 0.0);
  expect_shares(verify(with_pillar, two_beams(0.1), {1.0, 2.5, 0.0}), 0.0, 0.5, 0.5);
}

// A corridor of 2 m between walls of 12 m, open at its ends, beside a room: metres of wall, once along two
// directions and once along one. From a pose that the map does not explain neither holds anything.
TEST(Verify, ARoomHoldsAPoseAndACorridorHardly) {
  GridMap corridor = testing::empty_room(120, 22, 0.1);
  testing::fill(corridor, {0, 1}, {0, 20}, Occupancy::free);
  testing::fill(corridor, {119, 1}, {119, 20}, Occupancy::free);
  const auto held_m2 = [](const GridMap& grid, const Pose2& truth, const Pose2& T_map_robot) {
    return verify(grid, testing::look(PreparedMap(grid), testing::full_circle(360), truth), T_map_robot)
        .held_m2;
  };
  EXPECT_GT(held_m2(room, middle, middle), 60.0);
  EXPECT_LT(held_m2(room, middle, middle), (9.6 + 0.2) * (9.6 + 0.2));
  EXPECT_LT(held_m2(corridor, {6.0, 1.1, 0.0}, {6.0, 1.1, 0.0}), 20.0);
  EXPECT_LT(held_m2(room, middle, {1.5, 1.5, pi / 4}), 5.0);
}

TEST(Verify, TheTruePoseOfACleanScanExplainsItAll) {
  const PreparedMap map(testing::furnished_room({3.0, -2.0, 0.7}));
  std::vector<Pose2> T_map_robot(20);
  for (std::size_t i = 0; i < T_map_robot.size(); ++i)
    T_map_robot[i] =
        map.grid().T_map_grid * Pose2{1.03 + 0.3 * static_cast<double>(i),
                                      1.0 + 0.03 * static_cast<double>(i), 0.3 * static_cast<double>(i)};
  for (const Pose2& truth : T_map_robot) {
    const Scan scan = testing::look(map, testing::full_circle(360, 4.0), truth);  // some see no wall
    const std::vector<Verification> all = internal::verify(map.state(), scan, T_map_robot);
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (T_map_robot[i] == truth) {
        EXPECT_EQ(all[i].explained, 1.0);
      }
      EXPECT_LE(all[i].explained + all[i].blocked + all[i].seen_through, 1.0 + 1e-12);
    }
  }
}

}  // namespace
}  // namespace landfall
