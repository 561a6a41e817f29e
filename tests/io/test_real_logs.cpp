// The published logs: counts, first readings and time stamps as an independent look at the files gives.
#include <cmath>
#include <numbers>
#include <set>

#include "io_test.hpp"
#include "landfall/io.hpp"
#include "tests/data_folder.hpp"

namespace landfall::testing {
namespace {

struct Building {
  const char* name;
  std::size_t queries;
  std::size_t beams;
  double step_deg;
  double range_max_m;
  std::vector<float> first_ranges_m;
  Pose2 T_odom_robot;  // of the first query
};

const std::vector<Building> buildings = {{"intel",
                                          455,
                                          180,
                                          1.0,
                                          79.38,
                                          {1.72F, 1.66F, 1.64F},
                                          {.x_m = 0.7, .y_m = -0.018, .theta_rad = -1.02876}},
                                         {"csail",
                                          203,
                                          361,
                                          0.5,
                                          79.45,
                                          {6.08F, 6.06F, 6.06F},
                                          {.x_m = 576.575112, .y_m = -0.332928, .theta_rad = -0.772475}},
                                         {"aces",
                                          220,
                                          180,
                                          1.0,
                                          48.50,
                                          {3.24F, 3.29F, 3.34F},
                                          {.x_m = -0.049713, .y_m = -0.047729, .theta_rad = -0.535606}},
                                         {"acapulco",
                                          430,
                                          181,
                                          1.0,
                                          49.71,
                                          {7.45F, 7.45F, 7.75F},
                                          {.x_m = 0.936802, .y_m = 0.335926, .theta_rad = 0.471876}},
                                         {"infinite_corridor",
                                          970,
                                          180,
                                          1.0,
                                          49.63,
                                          {1.94F, 1.99F, 1.99F},
                                          {.x_m = 1.153167, .y_m = 0.031105, .theta_rad = 0.014819}}};

TEST(RealLogs, QueriesOfTheFiveBuildings) {
  LANDFALL_REQUIRE_DATA();
  for (const Building& building : buildings) {
    SCOPED_TRACE(building.name);
    const auto folder = data_folder() / building.name;
    const Log log = load_log(folder / "query.log.gz");
    const auto truth = load_trajectory(folder / "truth.tum");
    EXPECT_TRUE(log.warnings.empty());
    ASSERT_EQ(log.scans.size(), building.queries);
    ASSERT_EQ(truth.size(), building.queries);
    for (std::size_t i = 0; i < truth.size(); ++i) {
      EXPECT_EQ(log.scans[i].stamp_s, truth[i].stamp_s);
      EXPECT_EQ(log.scans[i].sensor, log.scans[0].sensor);
      EXPECT_NO_THROW(validate(log.scans[i]));
    }
    const Scan& scan = log.scans[0];
    ASSERT_EQ(scan.sensor->beams.size(), building.beams);
    for (std::size_t b = 0; b < building.first_ranges_m.size(); ++b)
      EXPECT_EQ(scan.ranges_m[b], building.first_ranges_m[b]);
    const Beam& second = scan.sensor->beams[1];
    EXPECT_NEAR(second.T_robot_beam.theta_rad, (building.step_deg - 90.0) * std::numbers::pi / 180.0, 1e-12);
    EXPECT_EQ(second.T_robot_beam.x_m, 0.0);
    EXPECT_EQ(second.range_max_m, building.range_max_m);
    EXPECT_EQ(scan.T_odom_robot, building.T_odom_robot);
  }
}

TEST(RealLogs, MappingScansCarryCorrectedPoses) {
  LANDFALL_REQUIRE_DATA();
  const Log log = load_log(data_folder() / "intel" / "map.log.gz");
  EXPECT_GT(log.scans.size(), 400U);
  std::size_t apart = 0;
  for (const Scan& scan : log.scans)
    apart += translation_distance(scan.T_map_robot.value(), scan.T_odom_robot.value()) > 0.5 ? 1 : 0;
  EXPECT_GT(apart, log.scans.size() / 2);  // odometry drifts, the corrected poses do not
}

TEST(RealLogs, WeanHallsLaserIsAheadOfTheCentre) {
  LANDFALL_REQUIRE_DATA();
  for (const auto& [name, scans] : {std::pair{"robotdata1.log.gz", 713U}, {"robotdata5.log.gz", 954U}}) {
    const Log log = load_log(data_folder() / "wean_hall" / name);
    ASSERT_EQ(log.scans.size(), scans);
    for (const Scan& scan : log.scans) {
      EXPECT_EQ(scan.sensor->beams[0].T_robot_beam.x_m, 0.25);
      // The log's laser pose is its odometry pose moved 0.25 m ahead; both are printed to 0.1 mm.
      EXPECT_LT(translation_distance(scan.T_map_robot.value(), scan.T_odom_robot.value()), 2e-4);
    }
  }
}

TEST(RealLogs, SonarTables) {
  LANDFALL_REQUIRE_DATA();
  const Log corridor = load_log(data_folder() / "sonar" / "corridor8_ranges.txt");
  ASSERT_EQ(corridor.scans.size(), 413U);
  EXPECT_TRUE(corridor.warnings.empty());
  EXPECT_EQ(corridor.scans[0].stamp_s, 1686.487);
  EXPECT_EQ(corridor.scans[0].ranges_m[2], 2.32F);
  EXPECT_EQ(corridor.scans[0].T_odom_robot, Pose2{});
  EXPECT_EQ(count_echoes(corridor.scans[0]), 4);
  for (const Scan& scan : corridor.scans) EXPECT_TRUE(scan.T_odom_robot);

  const Log ring = load_log(data_folder() / "sonar" / "scitos24.csv.gz");
  ASSERT_EQ(ring.scans.size(), 5456U);
  EXPECT_EQ(ring.scans[0].ranges_m[0], 0.438F);
  EXPECT_EQ(ring.scans[0].ranges_m[23], 0.429F);
  EXPECT_EQ(count_echoes(ring.scans[0]), 22);
}

class RealLogCopies : public IoTest {};

TEST_F(RealLogCopies, ConvertedLogReadsBackEqual) {
  LANDFALL_REQUIRE_DATA();
  for (const char* name :
       {"csail/query.log.gz", "wean_hall/robotdata1.log.gz", "sonar/corridor8_ranges.txt"}) {
    const Log log = load_log(data_folder() / name);
    save_log(log.scans, at("copy.jsonl"));
    const Log copy = load_log(at("copy.jsonl"));
    ASSERT_EQ(copy.scans.size(), log.scans.size());
    for (std::size_t i = 0; i < log.scans.size(); ++i) {
      EXPECT_EQ(copy.scans[i].ranges_m, log.scans[i].ranges_m);
      EXPECT_EQ(*copy.scans[i].sensor, *log.scans[i].sensor);
      EXPECT_EQ(copy.scans[i].T_odom_robot, log.scans[i].T_odom_robot);
      EXPECT_EQ(copy.scans[i].T_map_robot, log.scans[i].T_map_robot);
      EXPECT_EQ(copy.scans[i].stamp_s, log.scans[i].stamp_s);
    }
  }
}

}  // namespace
}  // namespace landfall::testing
