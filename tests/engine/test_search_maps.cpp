// Places that look alike, in one map and across several, and places that only seem to.
#include <gtest/gtest.h>

#include <cmath>

#include "engine/maps/prepared_state.hpp"
#include "landfall/search.hpp"
#include "rooms.hpp"

namespace landfall {
namespace {

using testing::draw_walls;
using testing::empty_map;
using testing::fill;
using testing::full_circle;
using testing::furnished_room;
using testing::look;

const SearchOptions coarse{.rotation_step_rad = 0.05};

SearchResult search_maps(const std::vector<PreparedMap>& maps, const Scan& scan) {
  const std::vector<PosePrior> anywhere{{Anywhere{}}};
  return search(maps, anywhere, std::vector<Scan>{scan}, coarse).front();
}

// Everything looks the same from the other end: half a turn about the middle.
TEST(Alike, AnEmptyRoomHasTwoAnswers) {
  const PreparedMap map(testing::empty_room(80, 60, 0.1));
  const Pose2 T_map_robot{2.05, 1.55, 0.5};
  const Pose2 T_map_twin{8.0 - 2.05, 6.0 - 1.55, 0.5 - std::numbers::pi};
  const SearchResult result = search(map, {Anywhere{}}, look(map, full_circle(120), T_map_robot), coarse);
  EXPECT_EQ(result.verdict, Verdict::ambiguous);
  ASSERT_GE(result.hypotheses.size(), 2u);
  const Pose2& first = result.hypotheses[0].T_map_robot;
  const Pose2& second = result.hypotheses[1].T_map_robot;
  const bool swapped = translation_distance(first, T_map_twin) < 0.1;
  EXPECT_LT(translation_distance(first, swapped ? T_map_twin : T_map_robot), 0.05);
  EXPECT_LT(translation_distance(second, swapped ? T_map_robot : T_map_twin), 0.05);
  EXPECT_NEAR(angle_distance(first.theta_rad, second.theta_rad), std::numbers::pi, 0.02);
  EXPECT_NEAR(result.hypotheses[0].probability, 0.5, 0.15);
}

TEST(Alike, APriorTellsTwinsApartAndItsWeightsCount) {
  const PreparedMap map(testing::empty_room(80, 60, 0.1));
  const Pose2 T_map_robot{2.05, 1.55, 0.5};
  const Pose2 T_map_twin{8.0 - 2.05, 6.0 - 1.55, 0.5 - std::numbers::pi};
  const Scan scan = look(map, full_circle(120), T_map_robot);
  const PosePrior here{Window{T_map_robot, 0.5, 0.5, 0.3}};
  const PosePrior there{Window{T_map_twin, 0.5, 0.5, 0.3}};
  EXPECT_EQ(search(map, here, scan, coarse).verdict, Verdict::found);
  EXPECT_EQ(search(map, there, scan, coarse).verdict, Verdict::found);
  const auto odds = [&](double weight) {
    const SearchResult result = search(map, {Mixture{{weight, 1.0}, {here, there}}}, scan, coarse);
    EXPECT_EQ(result.hypotheses.size(), 2u);
    const bool swapped = translation_distance(result.hypotheses[0].T_map_robot, T_map_twin) < 0.1;
    return result.hypotheses[swapped ? 1 : 0].probability / result.hypotheses[swapped ? 0 : 1].probability;
  };
  EXPECT_NEAR(odds(9.0) / odds(1.0), 9.0, 1e-6);
  EXPECT_NEAR(odds(0.2) / odds(1.0), 0.2, 1e-6);
}

TEST(SeveralMaps, TheOneThatFitsAnswers) {
  const PreparedMap other(testing::empty_room(90, 50, 0.1, {100.0, 0.0, 0.0}));
  const PreparedMap right(furnished_room());
  const Pose2 T_map_robot{2.31, 3.17, 0.4};
  const SearchResult result = search_maps({other, right}, look(right, full_circle(120), T_map_robot));
  ASSERT_FALSE(result.hypotheses.empty());
  EXPECT_EQ(result.hypotheses[0].map_index, 1);
  EXPECT_EQ(result.verdict, Verdict::found);
  EXPECT_LT(translation_distance(result.hypotheses[0].T_map_robot, T_map_robot), 0.05);
}

TEST(SeveralMaps, CopiesAreAmbiguous) {
  const PreparedMap map(furnished_room());
  const PreparedMap copy(furnished_room({30.0, -20.0, 1.0}));
  const Scan scan = look(map, full_circle(120), {2.31, 3.17, 0.4});
  ASSERT_EQ(search(map, {Anywhere{}}, scan, coarse).verdict, Verdict::found);
  const SearchResult result = search_maps({map, copy}, scan);
  EXPECT_EQ(result.verdict, Verdict::ambiguous);
  ASSERT_GE(result.hypotheses.size(), 2u);
  EXPECT_NE(result.hypotheses[0].map_index, result.hypotheses[1].map_index);
  EXPECT_EQ(result.hypotheses[0].score, result.hypotheses[1].score);
  EXPECT_NEAR(result.hypotheses[0].probability, result.hypotheses[1].probability, 0.05);
}

TEST(SeveralMaps, APriorMayLieOffSomeOfThem) {
  const PreparedMap map(furnished_room());
  const PreparedMap far(furnished_room({1000.0, 0.0, 0.0}));
  const Scan scan = look(map, full_circle(120), {2.31, 3.17, 0.4});
  const std::vector<PosePrior> here{{Window{{2.3, 3.2, 0.4}, 0.5, 0.5, 0.5}}};
  const SearchResult result =
      search(std::vector<PreparedMap>{far, map}, here, std::vector<Scan>{scan}, coarse).front();
  EXPECT_EQ(result.verdict, Verdict::found);
  EXPECT_EQ(result.hypotheses.at(0).map_index, 1);
}

// Beams that end 2.95 m or more away would have passed walls everywhere here, and the echoes lie in free
// space: no pose at the robot's place scores with method `grid`.
GridMap cluttered_place() {
  GridMap map = empty_map(80, 80, 0.1, {-1.0, -1.0, 0.0});
  for (int row = 12; row < 68; ++row)
    for (int col = 12; col < 68; ++col)
      fill(map, {col, row}, {col, row}, (col + row) % 2 == 0 ? Occupancy::unknown : Occupancy::occupied);
  fill(map, {40, 40}, {40, 40}, Occupancy::free);
  return map;
}

TEST(SeveralMaps, OneThatOffersNothingSaysNothingOfTheOthers) {
  const PreparedMap room(testing::empty_room(60, 60, 0.1));
  const PreparedMap cluttered(cluttered_place());
  const Pose2 T_map_robot{3.05, 3.05, 0.0};
  const Scan scan = look(room, full_circle(24), T_map_robot);
  const std::vector<PosePrior> here{{Window{T_map_robot, 0.01, 0.01, 0.0}}};
  const auto ask = [&](const std::vector<PreparedMap>& maps, const char* method) {
    return search(maps, here, std::vector<Scan>{scan}, {.method = method, .rotation_step_rad = 0.05}).front();
  };
  for (const char* method : {"grid", "grid_published", "grid_reduced"}) {
    SCOPED_TRACE(method);
    const SearchResult nothing = ask({cluttered}, method);
    ASSERT_TRUE(nothing.hypotheses.empty());
    EXPECT_EQ(nothing.reason, nothing.proven ? "no echo falls near a wall from any pose of the prior"
                                             : "no pose was found that fits");
    const SearchResult alone = ask({room}, method);
    ASSERT_FALSE(alone.hypotheses.empty());
    EXPECT_GT(alone.hypotheses[0].probability, 0.5);
    for (const SearchResult& beside : {ask({cluttered, room}, method), ask({room, cluttered}, method)}) {
      ASSERT_FALSE(beside.hypotheses.empty());
      EXPECT_EQ(beside.hypotheses[0].probability, alone.hypotheses[0].probability);
      EXPECT_EQ(beside.verdict, alone.verdict);
    }
  }
}

// Two rooms of the same size side by side. The left one has lost a piece of its walls (a door stands open:
// the field says less there); in the right one a screen stands between the robot's place and the walls, so
// that all beams would have to pass through it.
GridMap room_and_screened_room(int door_cells) {
  GridMap map = empty_map(170, 60, 0.1);
  draw_walls(map, {0, 0}, {79, 59});
  draw_walls(map, {90, 0}, {169, 59});
  for (const int left : {0, 90}) fill(map, {left + 10, 45}, {left + 30, 50}, Occupancy::occupied);
  if (door_cells > 0) fill(map, {20, 0}, {20 + door_cells - 1, 0}, Occupancy::free);
  draw_walls(map, {90 + 20, 20}, {90 + 26, 26});
  return map;
}

struct SeeingThroughWalls : ::testing::TestWithParam<int> {};

TEST_P(SeeingThroughWalls, LosesToSeeingWalls) {
  const PreparedMap map(room_and_screened_room(GetParam()));
  GridMap whole = room_and_screened_room(0);
  fill(whole, {90, 0}, {169, 59}, Occupancy::free);
  const Pose2 T_map_robot{2.35, 2.35, 0.0};
  const Pose2 T_map_twin{2.35 + 9.0, 2.35, 0.0};  // the middle of the screen's box
  const Scan scan = look(PreparedMap(whole), full_circle(180), T_map_robot);
  const SearchResult twin = search(map, {Window{T_map_twin, 0.3, 0.3, 0.1}}, scan, coarse);
  EXPECT_LT(twin.hypotheses.at(0).explained, 0.1);
  const SearchResult result = search(map, {Anywhere{}}, scan, coarse);
  ASSERT_FALSE(result.hypotheses.empty());
  EXPECT_GE(twin.hypotheses[0].score, result.hypotheses[0].score);
  EXPECT_LT(translation_distance(result.hypotheses[0].T_map_robot, T_map_robot), 0.1);
  EXPECT_GT(result.hypotheses[0].explained, 0.75);
}

INSTANTIATE_TEST_SUITE_P(DoorCells, SeeingThroughWalls, ::testing::Values(0, 1, 2, 5, 10, 20),
                         ::testing::PrintToStringParamName());

}  // namespace
}  // namespace landfall
