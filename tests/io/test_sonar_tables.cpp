#include <cmath>
#include <numbers>

#include "io_test.hpp"
#include "landfall/io.hpp"

namespace landfall::testing {
namespace {

constexpr double degree = std::numbers::pi / 180.0;

class SonarTables : public IoTest {
 protected:
  void expect_fault(const std::string& name, const std::string& table,
                    const std::vector<std::string>& parts) const {
    const auto path = write(name, table);
    expect_error([&] { load_log(path); }, ErrorCode::file_format, parts);
  }
};

std::string scitos_row(const std::string& first = "0.438") {
  std::string row = first;
  for (int i = 1; i < 24; ++i) row.append(",").append(std::to_string(i)).append(".5");
  return row + ",Move-Forward\n";
}

TEST_F(SonarTables, Corridor8) {
  write("corridor8_poses.txt", "2000 1500 -250 900\n2500 0 0 -1800\n");
  const Log log =
      load_log(write("corridor8_ranges.txt", "2000 5110 1 2 3 4 5 6 1190\n2500 1 2 3 4 5 6 7 8\n"));
  ASSERT_EQ(log.scans.size(), 2U);
  const Scan& scan = log.scans[0];
  EXPECT_EQ(scan.stamp_s, 2.0);
  EXPECT_EQ(scan.ranges_m[7], 1.19F);
  const Pose2 T_odom_robot = scan.T_odom_robot.value();
  EXPECT_NEAR(T_odom_robot.x_m, 1.5, 1e-12);
  EXPECT_NEAR(T_odom_robot.y_m, -0.25, 1e-12);
  EXPECT_NEAR(T_odom_robot.theta_rad, 90 * degree, 1e-12);
  const Sensor& sensor = *scan.sensor;
  ASSERT_EQ(sensor.beams.size(), 8U);
  EXPECT_EQ(classify(sensor.beams[0], scan.ranges_m[0]), Reading::no_echo);
  EXPECT_EQ(classify(sensor.beams[7], scan.ranges_m[7]), Reading::echo);
  const std::vector<double> bearings_deg = {-90, -50, -30, -10, 10, 30, 50, 90};
  for (std::size_t i = 0; i < 8; ++i) {
    EXPECT_NEAR(sensor.beams[i].T_robot_beam.theta_rad, bearings_deg[i] * degree, 1e-12);
    EXPECT_NEAR(std::hypot(sensor.beams[i].T_robot_beam.x_m, sensor.beams[i].T_robot_beam.y_m), 0.2, 1e-12);
  }
  EXPECT_NEAR(sensor.beams[0].half_angle_rad, 12.5 * degree, 1e-12);
  EXPECT_EQ(log.scans[1].sensor, scan.sensor);
}

TEST_F(SonarTables, Corridor8WithoutPosesHasNoOdometry) {
  const Log log = load_log(write("corridor8_ranges.txt", "2000 1 2 3 4 5 6 7 8\n"));
  EXPECT_FALSE(log.scans.at(0).T_odom_robot);
  EXPECT_THAT(log.warnings, ::testing::ElementsAre(::testing::HasSubstr("no odometry")));
}

TEST_F(SonarTables, Scitos24) {
  const Log log = load_log(write("scitos24.csv", scitos_row() + scitos_row("5.000")));
  ASSERT_EQ(log.scans.size(), 2U);
  EXPECT_EQ(log.scans[1].stamp_s, 1.0);
  EXPECT_FALSE(log.scans[0].T_odom_robot);
  EXPECT_EQ(log.scans[0].ranges_m[0], 0.438F);
  EXPECT_EQ(log.scans[0].ranges_m[23], 23.5F);
  const Sensor& sensor = *log.scans[0].sensor;
  // Numbered clockwise from the front: the seventh looks to the right.
  EXPECT_NEAR(sensor.beams[0].T_robot_beam.theta_rad, 0.0, 1e-12);
  EXPECT_NEAR(sensor.beams[6].T_robot_beam.theta_rad, -90 * degree, 1e-12);
  EXPECT_NEAR(sensor.beams[6].T_robot_beam.y_m, -0.28, 1e-12);
  EXPECT_EQ(classify(sensor.beams[0], log.scans[1].ranges_m[0]), Reading::no_echo);
}

TEST_F(SonarTables, TheCallersSensorReplacesTheirs) {
  const auto path = write("scitos24.csv", scitos_row());
  const auto ring = std::make_shared<const Sensor>(make_fan({.beams = 24, .step_rad = -15 * degree}));
  EXPECT_EQ(load_log(path, {.sensors = {{"scitos24", ring}}}).scans.at(0).sensor, ring);
  const auto wrong = std::make_shared<const Sensor>(make_fan({.beams = 8}));
  expect_error(
      [&] {
        load_log(path, {.sensors = {{"scitos24", wrong}}});
      },
      ErrorCode::invalid_argument, {"'scitos24': 8 beams, expected 24"});
}

TEST_F(SonarTables, Faults) {
  const std::string row = "2000 1 2 3 4 5 6 7 8\n";
  expect_fault("a_ranges.txt", row + "2001 1 2 3 4 5 6 7\n",
               {"a_ranges.txt:2: s7: found the end of the line"});
  expect_fault("a_ranges.txt", row + "2001 1 2 3 4 5 6 7 8 9\n", {"a_ranges.txt:2: column 10: found '9'"});
  expect_fault("a_ranges.txt", row + "2001 1 -2 3 4 5 6 7 8\n", {"a_ranges.txt:2: s1: found '-2'"});
  expect_fault("a_ranges.txt", row + "2001 1 nan 3 4 5 6 7 8\n", {"a_ranges.txt:2: s1: found 'nan'"});
  expect_fault("a_ranges.txt", row + "x 1 2 3 4 5 6 7 8\n", {"a_ranges.txt:2: t: found 'x'"});
  write("a_poses.txt", "1999 0 0 0\n");
  expect_fault("a_ranges.txt", row,
               {"a_ranges.txt:1: t: found '2000', expected a time stamp of", "a_poses.txt"});
  write("a_poses.txt", "2000 0 0\n");
  expect_fault("a_ranges.txt", row, {"a_poses.txt:1: theta: found the end of the line"});
  expect_fault("s.csv", scitos_row() + scitos_row("-1"), {"s.csv:2: s0: found '-1'"});
  expect_fault("s.csv", scitos_row() + "1,2,3\n", {"s.csv:2: s3: found the end of the line"});
  expect_fault("s.csv", scitos_row() + scitos_row("1,1"), {"s.csv:2: column 25"});
}

}  // namespace
}  // namespace landfall::testing
