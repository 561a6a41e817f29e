#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

#include "engine/io/file.hpp"
#include "io_test.hpp"
#include "landfall/io.hpp"

namespace landfall::testing {
namespace {

constexpr float nan = std::numeric_limits<float>::quiet_NaN();
constexpr const char* fan_line =
    R"({"sensor": {"name": "laser", "fan": {"beams": 3, "first_rad": -1, "step_rad": 1, "range_max_m": 30}}})"
    "\n";

class ScanLines : public IoTest {
 protected:
  Log load(const std::string& jsonl, const LoadLogOptions& options = {}) const {
    return load_log(write("drive.jsonl", jsonl), options);
  }
  void expect_fault(const std::string& line, const std::vector<std::string>& parts) const {
    expect_error([&] { load(fan_line + line); }, ErrorCode::file_format, parts);
  }
};

void expect_equal(const Scan& a, const Scan& b) {
  EXPECT_EQ(*a.sensor, *b.sensor);
  EXPECT_EQ(a.stamp_s, b.stamp_s);
  EXPECT_EQ(a.T_odom_robot, b.T_odom_robot);
  EXPECT_EQ(a.T_map_robot, b.T_map_robot);
  ASSERT_EQ(a.ranges_m.size(), b.ranges_m.size());
  for (std::size_t i = 0; i < a.ranges_m.size(); ++i)
    EXPECT_TRUE(a.ranges_m[i] == b.ranges_m[i] || (std::isnan(a.ranges_m[i]) && std::isnan(b.ranges_m[i])))
        << a.ranges_m[i] << " " << b.ranges_m[i];
}

TEST_F(ScanLines, LinesByHand) {
  const Log log =
      load(std::string(fan_line) +
           R"({"stamp_s": 12.5, "sensor": "laser", "ranges_m": [1.5, null, 30]})"
           "\n\n"
           R"({"stamp_s": 13, "sensor": "laser", "ranges_m": [0, 1, 2], "T_odom_robot": [1, 2, 3],)"
           R"( "T_map_robot": [4, 5, 6], "note": "other fields are passed over"})");
  ASSERT_EQ(log.scans.size(), 2U);
  EXPECT_EQ(log.scans[0].stamp_s, 12.5);
  EXPECT_EQ(log.scans[0].ranges_m[0], 1.5F);
  EXPECT_TRUE(std::isnan(log.scans[0].ranges_m[1]));
  EXPECT_EQ(classify(log.scans[0].sensor->beams[2], log.scans[0].ranges_m[2]), Reading::no_echo);
  EXPECT_FALSE(log.scans[0].T_odom_robot);
  EXPECT_EQ(log.scans[1].sensor, log.scans[0].sensor);
  EXPECT_EQ(log.scans[1].T_odom_robot, (Pose2{.x_m = 1, .y_m = 2, .theta_rad = 3}));
  EXPECT_EQ(log.scans[1].T_map_robot, (Pose2{.x_m = 4, .y_m = 5, .theta_rad = 6}));
}

TEST_F(ScanLines, SensorsFromTheCaller) {
  const auto mine = std::make_shared<const Sensor>(make_fan({.name = "x", .beams = 3, .step_rad = 0.1}));
  const std::string scan = R"({"stamp_s": 1, "sensor": "laser", "ranges_m": [1, 2, 3]})";
  EXPECT_EQ(load(scan, {.sensors = {{"laser", mine}}}).scans.at(0).sensor, mine);
  EXPECT_EQ(load(fan_line + scan, {.sensors = {{"laser", mine}}}).scans.at(0).sensor, mine);
}

TEST_F(ScanLines, SavedLogReadsBackEqual) {
  const auto laser = std::make_shared<const Sensor>(
      make_fan({.beams = 4, .first_rad = -1.5, .step_rad = std::numbers::pi / 180, .range_max_m = 79.38}));
  Sensor changed = *laser;
  changed.beams[2].T_robot_beam.x_m = 1.0 / 3.0;
  const auto other = std::make_shared<const Sensor>(changed);  // under the same name
  std::vector<Scan> scans(5);
  for (std::size_t i = 0; i < scans.size(); ++i) {
    scans[i].sensor = i == 2 || i == 3 ? other : laser;
    scans[i].ranges_m = {nan, 0.1F * static_cast<float>(i), 79.38F, 1.0F / 3.0F};
    scans[i].stamp_s = 976052892.4424 + static_cast<double>(i) / 7.0;
    if (i > 0) scans[i].T_odom_robot = Pose2{.x_m = 0.1, .y_m = -1.0 / 3.0, .theta_rad = 3.1};
    if (i > 1) scans[i].T_map_robot = Pose2{.x_m = 1e-9, .y_m = 2.0, .theta_rad = -3.1};
  }
  for (const char* name : {"drive.jsonl", "drive.jsonl.gz"}) {
    save_log(scans, at(name));
    EXPECT_EQ(io::is_gzip(read(at(name))), std::string(name) == "drive.jsonl.gz");
    const Log back = load_log(at(name));
    ASSERT_EQ(back.scans.size(), scans.size());
    for (std::size_t i = 0; i < scans.size(); ++i) expect_equal(back.scans[i], scans[i]);
  }
  EXPECT_EQ(load_sensors(at("drive.jsonl.gz")).size(), 1U);
}

TEST_F(ScanLines, InfinityIsWrittenAsTheMaximumAndNegativeAsInvalid) {
  const auto laser =
      std::make_shared<const Sensor>(make_fan({.beams = 2, .step_rad = 0.1, .range_max_m = 79.38}));
  Scan scan;
  scan.sensor = laser;
  scan.ranges_m = {std::numeric_limits<float>::infinity(), -1.0F};
  save_log(std::vector<Scan>{scan}, at("drive.jsonl"));
  const Scan back = load_log(at("drive.jsonl")).scans.at(0);
  EXPECT_EQ(classify(laser->beams[0], back.ranges_m[0]), Reading::no_echo);
  EXPECT_EQ(classify(laser->beams[1], back.ranges_m[1]), Reading::invalid);
}

TEST_F(ScanLines, FansOfAFileShareALimit) {
  const auto line = [](const std::string& name) {
    return R"({"sensor": {"name": ")" + name +
           R"(", "fan": {"beams": 1000000, "first_rad": 0, "step_rad": 0.1, "range_max_m": 8}}})" + "\n";
  };
  std::string again;
  std::string others;
  for (int i = 0; i < 11; ++i) {
    again += line("same");
    others += line("s" + std::to_string(i));
  }
  EXPECT_EQ(load_sensors(write("again.jsonl", again)).size(), 1U);
  EXPECT_TRUE(load_log(write("again.jsonl", again)).scans.empty());
  for (const auto& load : {std::function<void()>([&] { load_log(write("others.jsonl", others)); }),
                           std::function<void()>([&] { load_sensors(write("others.jsonl", others)); })})
    expect_error(load, ErrorCode::too_large, {"others.jsonl:11", "fan.beams", "1000000"});
}

TEST_F(ScanLines, Faults) {
  expect_fault("{\"stamp_s\": 1,",
               {"drive.jsonl:2: column 15: found the end of the text, expected valid JSON"});
  expect_fault(R"({"stamp_s": 1, "ranges_m": [1, 2, 3]})", {"drive.jsonl:2: sensor: found nothing"});
  expect_fault(R"({"stamp_s": 1, "sensor": "sonar", "ranges_m": [1, 2, 3]})",
               {"drive.jsonl:2: sensor: found 'sonar', expected a sensor that a line before"});
  expect_fault(R"({"stamp_s": 1, "sensor": 7, "ranges_m": [1, 2, 3]})", {"sensor: found 7, expected a text"});
  expect_fault(R"({"sensor": "laser", "ranges_m": [1, 2, 3]})", {"stamp_s: found nothing"});
  expect_fault(R"({"stamp_s": "1", "sensor": "laser", "ranges_m": [1, 2, 3]})", {"stamp_s: found '1'"});
  expect_fault(R"({"stamp_s": 1, "sensor": "laser"})", {"ranges_m: found nothing"});
  expect_fault(R"({"stamp_s": 1, "sensor": "laser", "ranges_m": [1, 2]})",
               {"ranges_m: found a list of 2, expected 3 ranges, as sensor 'laser' has beams"});
  expect_fault(R"({"stamp_s": 1, "sensor": "laser", "ranges_m": [1, -2, 3]})", {"ranges_m[1]: found -2"});
  expect_fault(R"({"stamp_s": 1, "sensor": "laser", "ranges_m": [1, "x", 3]})", {"ranges_m[1]: found 'x'"});
  expect_fault(R"({"stamp_s": 1, "sensor": "laser", "ranges_m": [1, NaN, 3]})", {"drive.jsonl:2: column"});
  expect_fault(R"({"stamp_s": 1, "sensor": "laser", "ranges_m": [1, 2, 3], "T_odom_robot": [1, 2]})",
               {"T_odom_robot: found a list of 2"});
  expect_fault(R"({"sensor": {"name": "b", "beams": [{"T_robot_beam": [0, 0, 0], "range_max_m": -1}]}})",
               {"drive.jsonl:2: ", "range_max_m"});
  expect_fault("[1, 2]", {"drive.jsonl:2: "});
}

}  // namespace
}  // namespace landfall::testing
