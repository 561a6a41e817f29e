#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "landfall/error.hpp"
#include "landfall/scan.hpp"

namespace landfall {
namespace {

using ::testing::HasSubstr;

constexpr double pi = std::numbers::pi;
constexpr float nan = std::numeric_limits<float>::quiet_NaN();
constexpr float infinity = std::numeric_limits<float>::infinity();

std::string error_of(const std::function<void()>& call) {
  try {
    call();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::invalid_argument);
    return error.what();
  }
  return "no error";
}

std::shared_ptr<const Sensor> fan(int beams) {
  return std::make_shared<const Sensor>(
      make_fan({.name = "fan", .beams = beams, .first_rad = -pi / 2, .step_rad = pi / 180.0}));
}

TEST(MakeFan, SpacesBeamsEvenlyFromItsMount) {
  const Sensor sensor = make_fan({.name = "rear",
                                  .beams = 3,
                                  .first_rad = -pi / 2,
                                  .step_rad = pi / 2,
                                  .T_robot_sensor = {.x_m = -0.2, .y_m = 0.1, .theta_rad = pi},
                                  .range_max_m = 30.0});
  ASSERT_EQ(sensor.beams.size(), 3u);
  EXPECT_NEAR(sensor.beams[0].T_robot_beam.theta_rad, pi / 2, 1e-12);
  EXPECT_NEAR(sensor.beams[1].T_robot_beam.theta_rad, pi, 1e-12);
  EXPECT_NEAR(sensor.beams[2].T_robot_beam.theta_rad, -pi / 2, 1e-12);
  for (const Beam& beam : sensor.beams) {
    EXPECT_DOUBLE_EQ(beam.T_robot_beam.x_m, -0.2);
    EXPECT_DOUBLE_EQ(beam.T_robot_beam.y_m, 0.1);
    EXPECT_DOUBLE_EQ(beam.range_max_m, 30.0);
  }
}

TEST(MakeFan, RefusesNumbersOfBeamsOutOfRange) {
  EXPECT_THAT(error_of([] { make_fan({.beams = 0}); }), HasSubstr("beams is 0"));
  EXPECT_THAT(error_of([] { make_fan({.beams = 2'000'000}); }), HasSubstr("beams is 2000000"));
}

TEST(ValidateSensor, NamesTheBeamAndTheField) {
  const Sensor good = *fan(3);
  EXPECT_NO_THROW(validate(good));
  const auto error_with = [&](const std::function<void(Sensor&)>& change) {
    Sensor bad = good;
    change(bad);
    return error_of([&] { validate(bad); });
  };
  EXPECT_THAT(error_with([](Sensor& s) { s.beams.clear(); }), HasSubstr("no beams"));
  EXPECT_THAT(error_with([](Sensor& s) { s.beams[1].T_robot_beam.y_m = nan; }),
              HasSubstr("beam 1: T_robot_beam.y_m is nan"));
  EXPECT_THAT(error_with([](Sensor& s) { s.beams[2].half_angle_rad = 4.0; }),
              HasSubstr("beam 2: half_angle_rad is 4"));
  EXPECT_THAT(error_with([](Sensor& s) { s.beams[0].half_angle_rad = -0.1; }),
              HasSubstr("beam 0: half_angle_rad"));
  EXPECT_THAT(error_with([](Sensor& s) { s.beams[0].range_min_m = -1.0; }),
              HasSubstr("beam 0: range_min_m is -1"));
  EXPECT_THAT(error_with([](Sensor& s) { s.beams[0].range_max_m = infinity; }),
              HasSubstr("beam 0: range_max_m is inf"));
  EXPECT_THAT(error_with([](Sensor& s) { s.beams[0].range_min_m = 90.0; }), HasSubstr("above range_min_m"));
  EXPECT_THAT(error_with([](Sensor& s) { s.range_noise_m = -0.1; }), HasSubstr("range_noise_m is -0.1"));
  EXPECT_THAT(error_with([](Sensor& s) { s.range_noise_relative = nan; }),
              HasSubstr("range_noise_relative is nan"));
}

TEST(Classify, TellsInvalidEchoAndNoEcho) {
  const Beam beam{.T_robot_beam = {}, .half_angle_rad = 0.0, .range_min_m = 0.1, .range_max_m = 10.0};
  for (const float range_m : {nan, -infinity, -1.0f, 0.0f, 0.09f})
    EXPECT_EQ(classify(beam, range_m), Reading::invalid) << range_m;
  for (const float range_m : {0.1f, 5.0f, 9.99f})
    EXPECT_EQ(classify(beam, range_m), Reading::echo) << range_m;
  for (const float range_m : {10.0f, 11.0f, infinity})
    EXPECT_EQ(classify(beam, range_m), Reading::no_echo) << range_m;
  EXPECT_EQ(classify(Beam{}, 0.0f), Reading::invalid);
}

TEST(Classify, TakesTheMaximumAsWrittenInALog) {
  // 81.91f is less than 81.91, 81.83f is more: neither may turn a maximum reading into an echo.
  for (const double max_m : {81.91, 81.83, 5.11}) {
    const Beam beam{.T_robot_beam = {}, .half_angle_rad = 0.0, .range_min_m = 0.0, .range_max_m = max_m};
    EXPECT_EQ(classify(beam, static_cast<float>(max_m)), Reading::no_echo) << max_m;
    EXPECT_EQ(classify(beam, static_cast<float>(max_m - 0.01)), Reading::echo) << max_m;
  }
}

TEST(Scan, CountsItsReadings) {
  const Scan scan{.sensor = fan(6), .ranges_m = {1.0f, nan, 80.0f, infinity, 0.0f, 79.0f}};
  EXPECT_EQ(count_valid(scan), 4);
  EXPECT_EQ(count_echoes(scan), 2);
}

TEST(ValidateScan, NamesWhatIsWrong) {
  const Scan good{.sensor = fan(2), .ranges_m = {1.0f, nan}};
  EXPECT_NO_THROW(validate(good));
  const auto error_with = [&](const std::function<void(Scan&)>& change) {
    Scan bad = good;
    change(bad);
    return error_of([&] { validate(bad); });
  };
  EXPECT_THAT(error_with([](Scan& s) { s.sensor = nullptr; }), HasSubstr("no sensor"));
  EXPECT_THAT(error_with([](Scan& s) { s.ranges_m.push_back(1.0f); }), HasSubstr("3 ranges, expected 2"));
  EXPECT_THAT(error_with([](Scan& s) { s.stamp_s = nan; }), HasSubstr("stamp_s is nan"));
  EXPECT_THAT(error_with([](Scan& s) { s.T_odom_robot = Pose2{.x_m = nan, .y_m = 0.0, .theta_rad = 0.0}; }),
              HasSubstr("T_odom_robot"));
  EXPECT_THAT(error_with([](Scan& s) { s.T_map_robot = Pose2{.x_m = 0.0, .y_m = nan, .theta_rad = 0.0}; }),
              HasSubstr("T_map_robot"));
}

TEST(Merge, SeesAllBeamsFromTheReference) {
  // Scan 1 is taken a metre ahead of scan 0 and turned left by 90 degrees.
  const auto one_beam = std::make_shared<const Sensor>(
      Sensor{.name = "one",
             .beams = {Beam{.T_robot_beam = {.x_m = 0.5, .y_m = 0.0, .theta_rad = 0.0}}},
             .range_noise_m = 0.02});
  const std::vector<Scan> scans{
      {.sensor = one_beam, .ranges_m = {3.0f}, .stamp_s = 10.0, .T_odom_robot = Pose2{5.0, 5.0, 0.0}},
      {.sensor = fan(1), .ranges_m = {4.0f}, .stamp_s = 11.0, .T_odom_robot = Pose2{6.0, 5.0, pi / 2}}};
  const Scan merged = merge(scans);
  EXPECT_NO_THROW(validate(merged));
  EXPECT_EQ(merged.stamp_s, 11.0);
  EXPECT_EQ(merged.T_odom_robot, scans[1].T_odom_robot);
  EXPECT_EQ(merged.ranges_m, (std::vector<float>{3.0f, 4.0f}));
  EXPECT_EQ(merged.sensor->range_noise_m, 0.02);
  // From scan 1, scan 0's beam starts half a metre to the left and points right.
  const Pose2& first = merged.sensor->beams[0].T_robot_beam;
  EXPECT_NEAR(first.x_m, 0.0, 1e-12);
  EXPECT_NEAR(first.y_m, 0.5, 1e-12);
  EXPECT_NEAR(first.theta_rad, -pi / 2, 1e-12);
  EXPECT_EQ(merged.sensor->beams[1], scans[1].sensor->beams[0]);
}

TEST(Merge, KeepsEndPointsWhereTheyAre) {
  const std::vector<Scan> scans{{.sensor = fan(3), .ranges_m = {1.0f, 2.0f, 3.0f}},
                                {.sensor = fan(3), .ranges_m = {4.0f, 5.0f, 6.0f}}};
  const std::vector<Pose2> T_common_robot{{1.0, 2.0, 0.3}, {-2.0, 0.5, -2.0}};
  const auto end = [](const Pose2& T_a_robot, const Scan& scan, std::size_t b) {
    return T_a_robot * scan.sensor->beams[b].T_robot_beam * Point2{.x_m = scan.ranges_m[b], .y_m = 0.0};
  };
  for (const std::size_t reference : {0u, 1u}) {
    const Scan merged = merge(scans, T_common_robot, reference);
    for (std::size_t b = 0; b < 6; ++b) {
      const Point2 expected = end(T_common_robot[b / 3], scans[b / 3], b % 3);
      const Point2 found = end(T_common_robot[reference], merged, b);
      EXPECT_NEAR(found.x_m, expected.x_m, 1e-12);
      EXPECT_NEAR(found.y_m, expected.y_m, 1e-12);
    }
  }
}

TEST(Merge, RefusesWhatDoesNotFit) {
  const Scan scan{.sensor = fan(1), .ranges_m = {1.0f}};
  const std::vector<Scan> scans{scan, scan};
  EXPECT_THAT(error_of([&] { merge(scans, std::vector<Pose2>(1), 0); }), HasSubstr("1 poses for 2 scans"));
  EXPECT_THAT(error_of([&] { merge(scans, std::vector<Pose2>(2), 2); }), HasSubstr("reference is 2"));
  EXPECT_THAT(error_of([&] { merge({}); }), HasSubstr("no scans"));
  EXPECT_THAT(error_of([&] { merge(scans); }), HasSubstr("scan 0 has no T_odom_robot"));
  EXPECT_THAT(error_of([&] {
                merge(scans, std::vector<Pose2>{{}, {nan, 0.0, 0.0}}, 0);
              }),
              HasSubstr("pose 1"));
}

TEST(Measured, IsOneScanOfReadings) {
  const auto scan_of = [](float range_m) { return Scan{.sensor = fan(1), .ranges_m = {range_m}}; };
  Scan condensed = scan_of(1.0f);
  condensed.measured = std::make_shared<const Scan>(scan_of(2.0f));
  EXPECT_NO_THROW(validate(condensed));
  Scan twice = scan_of(1.0f);
  twice.measured = std::make_shared<const Scan>(condensed);
  EXPECT_THAT(error_of([&] { validate(twice); }), HasSubstr("measured is a condensed scan"));
  Scan without_sensor = scan_of(1.0f);
  without_sensor.measured = std::make_shared<const Scan>();
  EXPECT_THAT(error_of([&] { validate(without_sensor); }), HasSubstr("no sensor"));
  Scan with_parts = condensed;
  with_parts.parts = ScanParts{.beams = {1}, .T_reference_robot = {Pose2{}}};
  EXPECT_THAT(error_of([&] { validate(with_parts); }), HasSubstr("measured and parts"));
  EXPECT_EQ(merge(std::vector<Scan>{condensed}, std::vector<Pose2>(1), 0).measured, nullptr);
}

}  // namespace
}  // namespace landfall
