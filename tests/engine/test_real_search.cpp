// Real buildings. Skipped where there is no data.
#include <gtest/gtest.h>

#include <algorithm>

#include "data_folder.hpp"
#include "landfall/io.hpp"
#include "random_world.hpp"
#include "same_answer.hpp"

namespace landfall {
namespace {

TEST(Intel, BranchAndBoundEqualsExhaustiveAndIsRight) {
  LANDFALL_REQUIRE_DATA();
  const std::filesystem::path folder = testing::data_folder() / "intel";
  const PreparedMap map = load_map(folder / "map.yaml");
  const std::vector<Scan> queries = load_log(folder / "query.log.gz").scans;
  const std::vector<StampedPose> truth = load_trajectory(folder / "truth.tum");
  ASSERT_EQ(queries.size(), truth.size());
  for (const std::size_t i : {40U, 200U, 333U, 420U}) {
    SCOPED_TRACE("query " + std::to_string(i));
    SearchOptions options{.method = "exhaustive", .rotation_step_rad = 2.0 * std::numbers::pi / 180};
    const SearchResult expected = search(map, {Anywhere{}}, queries[i], options);
    options.method = "branch_and_bound";
    const SearchResult actual = search(map, {Anywhere{}}, queries[i], options);
    testing::expect_same_answer(actual, expected);
    ASSERT_FALSE(actual.hypotheses.empty());
    EXPECT_LT(translation_distance(actual.hypotheses[0].T_map_robot, truth[i].pose), 0.25);
    EXPECT_LT(angle_distance(actual.hypotheses[0].T_map_robot.theta_rad, truth[i].pose.theta_rad), 0.052);
    EXPECT_LT(actual.counts.poses_scored, expected.counts.poses_scored / 10);
  }
}

// Floors 2, 3 and 4 of a mall. More than half of the walls of 3 and 4 are the same, at the same place.
struct Mall {
  std::vector<PreparedMap> floors;
  static constexpr int third = 1;  // index of floor 3
  static constexpr int fourth = 2;
  const std::shared_ptr<const Sensor> scanner =
      std::make_shared<const Sensor>(make_fan({.beams = 180,
                                               .first_rad = -std::numbers::pi,
                                               .step_rad = std::numbers::pi / 90,
                                               .range_max_m = 20.0}));

  Mall() {
    LoadMapOptions options;
    options.walls.resolution_m = 0.1;
    options.walls.outside_unknown = true;
    for (const char* floor : {"F2", "F3", "F4"})
      floors.push_back(load_map(
          testing::data_folder() / "plans" / ("mall_site1_" + std::string(floor) + ".json"), options));
  }
  // From a free place of floor 3 with walls around.
  [[nodiscard]] Scan look(testing::Dice& dice) const {
    const PreparedMap& map = floors[third];
    while (true) {
      const Pose2 T_map_robot = testing::random_pose(dice, map.grid());
      if (map.grid().at(map.grid().cell_of({T_map_robot.x_m, T_map_robot.y_m})) != Occupancy::free) continue;
      Scan scan = simulate(map, scanner, std::vector<Pose2>{T_map_robot}, {.seed = 1}).front();
      if (count_echoes(scan) > 160) return scan;
    }
  }
  // Share of the beams that floor 4 would answer alike from the same place.
  [[nodiscard]] double shared_with_fourth(const Scan& scan) const {
    const std::vector<float> ranges_m =
        simulate_ranges(floors[fourth], *scanner, std::vector<Pose2>{*scan.T_map_robot});
    int same = 0;
    for (std::size_t b = 0; b < ranges_m.size(); ++b)
      same += std::abs(std::min(ranges_m[b], 20.0F) - scan.ranges_m[b]) < 0.1F ? 1 : 0;
    return same / static_cast<double>(ranges_m.size());
  }
};

TEST(MallFloors, AreNotMistakenForEachOther) {
  LANDFALL_REQUIRE_DATA();
  const Mall mall;
  const std::vector<PosePrior> anywhere{{Anywhere{}}};
  testing::Dice dice(60);
  int shared = 0;
  int found = 0;
  for (int i = 0; i < 16; ++i) {
    const Scan scan = mall.look(dice);
    const double share = mall.shared_with_fourth(scan);
    const SearchResult result =
        search(mall.floors, anywhere, std::vector<Scan>{scan}, {.rotation_step_rad = 0.03}).front();
    SCOPED_TRACE("place " + std::to_string(i) + ", " + std::to_string(share) + " shared");
    ASSERT_FALSE(result.hypotheses.empty());
    if (share >= 0.99) {
      ++shared;
      EXPECT_EQ(result.verdict, Verdict::ambiguous);
    }
    if (result.verdict != Verdict::found) continue;
    ++found;
    EXPECT_EQ(result.hypotheses[0].map_index, Mall::third);
    EXPECT_LT(translation_distance(result.hypotheses[0].T_map_robot, *scan.T_map_robot), 0.2);
  }
  EXPECT_GE(shared, 3);
  EXPECT_GE(found, 3);
}

}  // namespace
}  // namespace landfall
