// Every field of a CARMEN message, damaged.
#include "engine/io/file.hpp"
#include "io_test.hpp"
#include "landfall/io.hpp"

namespace landfall::testing {
namespace {

class CarmenFaults : public IoTest {
 protected:
  void expect_fault(const std::string& log, const std::vector<std::string>& parts) const {
    const auto path = write("drive.log", "# CARMEN log\n" + log);
    expect_error([&] { load_log(path); }, ErrorCode::file_format, parts);
  }
};

TEST_F(CarmenFaults, TooFewRanges) {
  expect_fault("FLASER 3 1 2  0 0 0 0 0 0 5.5 host 5.5\n",
               {"drive.log:2: FLASER readings: found 9 numbers, expected 10: 3 ranges and 7 more"});
  // The first oddity is elsewhere: a negative coordinate where a range should be.
  expect_fault("FLASER 3 1 2  -7 0 0 0 0 0 5.5 host 5.5\n", {"found 9 numbers, expected 10"});
  expect_fault("FLASER 180 1 2  0 0 0 0 0 0 5.5 host 5.5\n", {"found 9 numbers, expected 187: 180 ranges"});
  expect_fault("RLASER 3 1 2\n", {"drive.log:2: RLASER readings: found 2 numbers, expected 10"});
  expect_fault("FLASER 3 1 2 3 0 0 0 0 0 0 5.5 host 5.5\nFLASER 3 1 2 3 0 0",
               {"drive.log:3: FLASER readings: found 5 numbers"});
}

TEST_F(CarmenFaults, TooManyRanges) {
  expect_fault("FLASER 2 1 2 3  0 0 0 0 0 0 5.5 host 5.5\n",
               {"FLASER readings: found 10 numbers, expected 9: 2 ranges and 7 more"});
}

TEST_F(CarmenFaults, NumberOfReadings) {
  expect_fault("FLASER\n", {"FLASER number of readings: found the end of the line"});
  expect_fault("FLASER many 1 2\n", {"number of readings: found 'many', expected a whole number >= 0"});
  expect_fault("FLASER -3 1 2 3 0 0 0 0 0 0 5 host 5\n", {"number of readings: found '-3'"});
  expect_fault("FLASER 2.5 1 2 0 0 0 0 0 0 5 host 5\n", {"number of readings: found '2.5'"});
  expect_fault("FLASER 99999999999 1 2 0 0 0 0 0 0 5 host 5\n", {"number of readings: found '99999999999'"});
  expect_fault("FLASER 2000000000 1 2 0 0 0 0 0 0 5 host 5\n", {"2000000000 ranges"});
}

TEST_F(CarmenFaults, Ranges) {
  expect_fault("FLASER 3 1 nan 3 0 0 0 0 0 0 5 host 5\n",
               {"drive.log:2: FLASER range 1: found 'nan'", ">= 0"});
  expect_fault("FLASER 3 1 -2 3 0 0 0 0 0 0 5 host 5\n", {"drive.log:2: FLASER range 1: found '-2'"});
  expect_fault("FLASER 3 1 2 3m 0 0 0 0 0 0 5 host 5\n", {"drive.log:2: FLASER range 2: found '3m'"});
}

TEST_F(CarmenFaults, PosesAndStamp) {
  expect_fault("FLASER 1 1 0 x 0 0 0 0 5 host 5\n",
               {"FLASER x y theta: found 'x', expected a finite number"});
  expect_fault("FLASER 1 1 0 0 0 0 inf 0 5 host 5\n", {"FLASER odom_x odom_y odom_theta: found 'inf'"});
  expect_fault("FLASER 1 1 0 0 0 0 0 0 now host 5\n", {"FLASER timestamp: found 'now'"});
  expect_fault("ODOM 1 2\n", {"ODOM x y theta: found the end of the line"});
}

TEST_F(CarmenFaults, RobotAndRawLasers) {
  expect_fault("ROBOTLASER1 0 a 2 0.5 30 0.01 0 1 1 0 0 0 0 0 0 0 0 0 0 0 0 7 host 7\n",
               {"ROBOTLASER1 start_angle: found 'a'"});
  expect_fault("ROBOTLASER1 0 -1 2 0.5 30 0.01 0 2 1 0 0 0 0 0 0 0 0 0 0 0 0 7 host 7\n",
               {"drive.log:2: ROBOTLASER1"});
  expect_fault("ROBOTLASER1 0 -1 2 0.5 30 0.01 0 1 1 9 0 0 0 0 0 0 7 host 7\n", {"ROBOTLASER1 remission"});
  expect_fault("RAWLASER1 0 -1 2 0.5 30 0.01 0 2 1 -1 0 7 host 7\n", {"RAWLASER1 range 1: found '-1'"});
  expect_fault("RAWLASER1 0 -1 2 1e308 30 0.01 0 3 1 1 1 0 7 host 7\n", {"drive.log:2: ", "beam"});
}

TEST_F(CarmenFaults, Sonar) {
  expect_fault("SONAR 0.5 2 1 1 0 0 0 8 host 8\n", {"SONAR offset: found 'host'"});
  expect_fault("SONAR 9.5 1 1 0 0 0 8 host 8\n", {"drive.log:2: ", "half_angle_rad"});
}

TEST_F(CarmenFaults, Parameters) {
  expect_fault("PARAM robot_front_laser_max far host 0\n",
               {"drive.log:2: robot_front_laser_max: found 'far', expected a finite number"});
  expect_fault("PARAM robot_front_laser_max 0 host 0\n",
               {"robot_front_laser_max: found '0', expected a positive"});
  expect_fault("PARAM laser_front_laser_resolution -1 host 0\n",
               {"laser_front_laser_resolution: found '-1'"});
  expect_fault("PARAM robot_frontlaser_offset\n", {"robot_frontlaser_offset: found nothing"});
}

TEST_F(CarmenFaults, NoScans) {
  expect_fault("ODOM 1 2 3 0 0 0 7 host 7\n", {"drive.log: found no scan, expected a FLASER"});
}

TEST_F(CarmenFaults, NoLogAtAll) {
  expect_fault("", {"drive.log: found no line but comments, expected one of CARMEN text, scan lines"});
  expect_fault("hello world\n", {"drive.log: found a log that starts with 'hello world'"});
  expect_error([&] { load_log(at("none.log")); }, ErrorCode::file_not_found, {"none.log: no such file"});
}

TEST_F(CarmenFaults, TruncatedGzip) {
  std::string log;
  for (int i = 0; i < 2000; ++i)
    log +=
        "FLASER 2 " + std::to_string(i * 7919 % 1000) + " 2 0 0 0 0 0 0 " + std::to_string(i) + " host 5\n";
  const std::string packed = io::gzip(log);
  EXPECT_EQ(load_log(write("whole.log.gz", packed)).scans.size(), 2000U);
  for (const std::size_t bytes : {packed.size() - 1, packed.size() / 2, std::size_t{11}, std::size_t{3}}) {
    const auto path = write("short.log.gz", packed.substr(0, bytes));
    expect_error([&] { load_log(path); }, ErrorCode::file_format, {"short.log.gz: gzip: ", "truncated"});
  }
}

}  // namespace
}  // namespace landfall::testing
