// CARMEN messages written by hand, and what they mean.
#include <cmath>
#include <numbers>

#include "io_test.hpp"
#include "landfall/io.hpp"

namespace landfall::testing {
namespace {

constexpr double pi = std::numbers::pi;

class Carmen : public IoTest {
 protected:
  Log load(const std::string& log, const LoadLogOptions& options = {}) const {
    return load_log(write("drive.log", log), options);
  }
};

void expect_pose(const Pose2& pose, const Pose2& expected) {
  EXPECT_NEAR(pose.x_m, expected.x_m, 1e-9);
  EXPECT_NEAR(pose.y_m, expected.y_m, 1e-9);
  EXPECT_NEAR(angle_distance(pose.theta_rad, expected.theta_rad), 0.0, 1e-9);
}

std::string readings(int count, double range_m) {
  std::string text = std::to_string(count);
  for (int i = 0; i < count; ++i) text.append(" ").append(std::to_string(range_m));
  return text;
}

constexpr const char* poses = " 1 2 0 1 2 0 10.5 host 10.6\n";

TEST_F(Carmen, FrontLaser) {
  const Log log = load(
      "# made by hand\nPARAM robot_front_laser_max 50.0 host 0\n"
      "PARAM laser_front_laser_resolution 45 host 0\n"
      "FLASER 3 1.5 2 81.91  4 5 0.5  4.5 5.5 0.6  976052892.442400 host 1.0\r\n");
  ASSERT_EQ(log.scans.size(), 1U);
  const Scan& scan = log.scans[0];
  EXPECT_EQ(scan.ranges_m, (std::vector<float>{1.5F, 2.0F, 81.91F}));
  EXPECT_EQ(scan.stamp_s, 976052892.442400);
  ASSERT_TRUE(scan.T_odom_robot && scan.T_map_robot);
  expect_pose(*scan.T_odom_robot, {.x_m = 4.5, .y_m = 5.5, .theta_rad = 0.6});
  expect_pose(*scan.T_map_robot, {.x_m = 4.0, .y_m = 5.0, .theta_rad = 0.5});
  EXPECT_EQ(scan.sensor->name, "front_laser");
  EXPECT_EQ(scan.sensor->range_noise_m, 0.02);
  ASSERT_EQ(scan.sensor->beams.size(), 3U);
  for (int i = 0; i < 3; ++i) {
    expect_pose(scan.sensor->beams[i].T_robot_beam, {.theta_rad = (-90.0 + 45.0 * i) * pi / 180.0});
    EXPECT_EQ(scan.sensor->beams[i].range_max_m, 50.0);
    EXPECT_EQ(scan.sensor->beams[i].half_angle_rad, 0.0);
  }
  EXPECT_EQ(classify(scan.sensor->beams[2], scan.ranges_m[2]), Reading::no_echo);
}

TEST_F(Carmen, FrontLaserOffsetMovesBeamsAndPose) {
  const Log log = load(
      "PARAM robot_frontlaser_offset 0.25 host 0\nPARAM robot_frontlaser_side_offset -0.1 host 0\n"
      "FLASER 1 5  1 2 1.5707963267948966  0 0 0  1 host 1\n");
  const Scan& scan = log.scans.at(0);
  expect_pose(scan.sensor->beams[0].T_robot_beam, {.x_m = 0.25, .y_m = -0.1, .theta_rad = -pi / 2});
  // Facing the map's y: the centre is 0.25 m back along y and, the laser being to the right, 0.1 m to -x.
  expect_pose(*scan.T_map_robot, {.x_m = 0.9, .y_m = 1.75, .theta_rad = pi / 2});
}

TEST_F(Carmen, RearLaserLooksBackwards) {
  for (const char* offset : {"0.3", "-0.3"}) {
    const Log log = load("PARAM robot_rearlaser_offset " + std::string(offset) + " host 0\n" +
                         "PARAM robot_rear_laser_max 20 host 0\nRLASER 181" + readings(181, 3.0).substr(3) +
                         " -0.3 0 3.141592653589793  0 0 0  1 host 1\n");
    const Scan& scan = log.scans.at(0);
    EXPECT_EQ(scan.sensor->name, "rear_laser");
    expect_pose(scan.sensor->beams[90].T_robot_beam, {.x_m = -0.3, .theta_rad = pi});
    expect_pose(scan.sensor->beams[0].T_robot_beam, {.x_m = -0.3, .theta_rad = pi / 2});
    EXPECT_EQ(scan.sensor->beams[0].range_max_m, 20.0);
    expect_pose(*scan.T_map_robot, {});
  }
}

TEST_F(Carmen, ResolutionIsGuessedAsCarmenDoes) {
  for (const auto& [beams, step_deg] : std::vector<std::pair<int, double>>{
           {180, 1.0}, {181, 1.0}, {360, 0.5}, {361, 0.5}, {401, 0.25}, {91, 2.0}}) {
    const Log log = load("FLASER " + readings(beams, 2.0) + poses);
    const auto& sensor = *log.scans.at(0).sensor;
    EXPECT_NEAR(sensor.beams[1].T_robot_beam.theta_rad, (-90.0 + step_deg) * pi / 180.0, 1e-12) << beams;
    EXPECT_EQ(sensor.beams[0].range_max_m, 80.0);
  }
}

TEST_F(Carmen, ScansOfOneGeometryShareTheirSensor) {
  const Log log =
      load("FLASER 2 1 1" + std::string(poses) + "FLASER 2 1 2" + poses + "FLASER 3 1 2 3" + poses +
           "PARAM robot_front_laser_max 30 host 0\nFLASER 2 1 1" + poses + "FLASER 2 1 1" + poses);
  ASSERT_EQ(log.scans.size(), 5U);
  EXPECT_EQ(log.scans[0].sensor, log.scans[1].sensor);
  EXPECT_NE(log.scans[0].sensor, log.scans[2].sensor);
  EXPECT_NE(log.scans[0].sensor, log.scans[3].sensor);
  EXPECT_EQ(log.scans[3].sensor, log.scans[4].sensor);
  EXPECT_EQ(log.scans[0].sensor->beams[0].range_max_m, 80.0);
  EXPECT_EQ(log.scans[3].sensor->beams[0].range_max_m, 30.0);
}

// type start fov step max accuracy mode | n ranges | m remissions | laser pose | robot pose | motion | stamp
constexpr const char* robot_laser_1 =
    "ROBOTLASER1 0 -1.0 2.0 0.5 30.0 0.01 0 3 1 2 3 2 0.1 0.2 5.2 1 0 5 1 0 0.4 0 0.5 0.4 1e6 7.25 host "
    "7.3\n";

TEST_F(Carmen, RobotLaserStatesItsGeometry) {
  const Log log = load(robot_laser_1);
  const Scan& scan = log.scans.at(0);
  EXPECT_EQ(scan.stamp_s, 7.25);
  EXPECT_EQ(scan.ranges_m, (std::vector<float>{1, 2, 3}));
  expect_pose(scan.sensor->beams[0].T_robot_beam, {.x_m = 0.2, .theta_rad = -1.0});
  expect_pose(scan.sensor->beams[2].T_robot_beam, {.x_m = 0.2, .theta_rad = 0.0});
  EXPECT_EQ(scan.sensor->beams[0].range_max_m, 30.0);
  expect_pose(*scan.T_odom_robot, {.x_m = 5, .y_m = 1});
  expect_pose(*scan.T_map_robot, {.x_m = 5, .y_m = 1});
}

TEST_F(Carmen, MountIsKeptWhereLaserPosesAloneAreCorrected) {
  const Log log = load(std::string(robot_laser_1) +
                       "ROBOTLASER1 0 -1.0 2.0 0.5 30.0 0.01 0 3 1 2 3 0 7.2 2 0 6 1 0 0 0 0 0 0 8 host 8\n");
  EXPECT_EQ(log.scans.at(0).sensor, log.scans.at(1).sensor);
  expect_pose(*log.scans[1].T_odom_robot, {.x_m = 6, .y_m = 1});
  expect_pose(*log.scans[1].T_map_robot, {.x_m = 7, .y_m = 2});
}

TEST_F(Carmen, RearRobotLaserMayEvenSitAhead) {
  const Log log =
      load("ROBOTLASER2 0 0 1 0.5 30.0 0.01 0 1 1 0 5.1 1 3.14159265358979 5 1 0 0 0 0 0 0 7.25 host 7.3\n");
  EXPECT_EQ(log.scans.at(0).sensor->name, "rear_laser");
  expect_pose(log.scans[0].sensor->beams[0].T_robot_beam, {.x_m = 0.1, .theta_rad = pi});
}

TEST_F(Carmen, LinesWithoutReadingsArePassedOverWithOneWarning) {
  const std::string none = "FLASER 0 0 0 0 0 0 0 1 host 1\n";
  const Log log = load("SONAR 0 1 host 1\n" + none + none + "FLASER 1 2" + poses);
  EXPECT_EQ(log.scans.size(), 1U);
  EXPECT_THAT(log.warnings, ::testing::UnorderedElementsAre(
                                ::testing::HasSubstr("drive.log:1: SONAR: no readings, 1 line"),
                                ::testing::HasSubstr("drive.log:2: front_laser: no readings, 2 lines")));
}

TEST_F(Carmen, RawLaserTakesTheLatestOdometry) {
  const std::string raw = "RAWLASER1 0 -1.0 2.0 0.5 30.0 0.01 0 3 1 2 3 0 7.25 host 7.3\n";
  const Log log = load(raw + "ODOM 1 2 3 0 0 0 7 host 7\n" + raw);
  ASSERT_EQ(log.scans.size(), 2U);
  EXPECT_FALSE(log.scans[0].T_odom_robot);
  expect_pose(log.scans[1].T_odom_robot.value(), {.x_m = 1, .y_m = 2, .theta_rad = 3});
  EXPECT_FALSE(log.scans[1].T_map_robot);
}

TEST_F(Carmen, RawLaserIsDroppedWhereTheLogRepeatsItWithPoses) {
  const std::string raw = "RAWLASER1 0 -1.0 2.0 0.5 30.0 0.01 0 3 1 2 3 0 7.25 host 7.3\n";
  std::string raw_rear = raw;
  raw_rear[8] = '2';
  const Log log = load(raw + robot_laser_1 + raw + raw_rear);
  ASSERT_EQ(log.scans.size(), 2U);
  EXPECT_EQ(log.scans[0].sensor->name, "front_laser");
  EXPECT_EQ(log.scans[1].sensor->name, "rear_laser");
  EXPECT_THAT(log.warnings, ::testing::ElementsAre(::testing::HasSubstr("RAWLASER")));
}

TEST_F(Carmen, SonarWithItsOwnOffsets) {
  const Log log = load(
      "ODOM 1 2 3 0 0 0 7 host 7\nPARAM robot_max_sonar 4 host 0\n"
      "SONAR 0.5 2 1.25 4.0 0.1 0.2 1.5 -0.1 0.2 -1.5 8.5 host 8.6\n");
  const Scan& scan = log.scans.at(0);
  EXPECT_EQ(scan.ranges_m, (std::vector<float>{1.25F, 4.0F}));
  EXPECT_EQ(scan.stamp_s, 8.5);
  EXPECT_EQ(scan.sensor->name, "sonar");
  expect_pose(scan.sensor->beams[1].T_robot_beam, {.x_m = -0.1, .y_m = 0.2, .theta_rad = -1.5});
  EXPECT_EQ(scan.sensor->beams[0].half_angle_rad, 0.25);
  EXPECT_EQ(classify(scan.sensor->beams[1], scan.ranges_m[1]), Reading::no_echo);
  expect_pose(scan.T_odom_robot.value(), {.x_m = 1, .y_m = 2, .theta_rad = 3});
}

TEST_F(Carmen, OldSonarTakesOffsetsFromParamOrFromTheCaller) {
  const std::string sonar = "SONAR 2 1.25 4.0 8.5 host 8.6\n";
  const Log given = load("PARAM robot_sonar_offsets 0.1 0 0.7 0.1 0 -0.7 1.0 host 0\n" + sonar);
  expect_pose(given.scans.at(0).sensor->beams.at(1).T_robot_beam, {.x_m = 0.1, .theta_rad = -0.7});

  const Log log = load(std::string(robot_laser_1) + sonar);
  EXPECT_EQ(log.scans.size(), 1U);
  EXPECT_THAT(log.warnings, ::testing::ElementsAre(::testing::HasSubstr("drive.log:2: SONAR")));

  const auto ring = std::make_shared<const Sensor>(make_fan({.name = "ring", .beams = 2, .step_rad = pi}));
  EXPECT_EQ(load(sonar, {.sensors = {{"sonar", ring}}}).scans.at(0).sensor, ring);
}

TEST_F(Carmen, TheCallersSensorReplacesTheLogs) {
  const auto mine = std::make_shared<const Sensor>(make_fan({.name = "mine", .beams = 3, .step_rad = 0.1}));
  const std::string line = "FLASER 3 1 2 3" + std::string(poses);
  EXPECT_EQ(load(line, {.sensors = {{"front_laser", mine}}}).scans.at(0).sensor, mine);
  expect_error(
      [&] {
        load("FLASER 2 1 2" + std::string(poses), {.sensors = {{"front_laser", mine}}});
      },
      ErrorCode::file_format, {"drive.log:1", "found 2", "expected 3", "'front_laser'"});
}

TEST_F(Carmen, OtherMessagesAndOtherParametersArePassedOver) {
  const Log log = load(
      "SYNC tag 0 host 0\nTRUEPOS nonsense\nPARAM robot_length abc host 0\nGLOBALPOS x\n\n  \n"
      "FLASER 1 2" +
      std::string(poses) + "COMMENT FLASER\n");
  EXPECT_EQ(log.scans.size(), 1U);
  EXPECT_TRUE(log.warnings.empty());
}

TEST_F(Carmen, StampsMayStandAlone) {
  EXPECT_EQ(load("FLASER 2 1 2  1 2 0 1 2 0 10.5\n").scans.at(0).stamp_s, 10.5);
}

}  // namespace
}  // namespace landfall::testing
