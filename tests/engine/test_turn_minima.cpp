// The minimum filter over all sonars together: plateaus on drawn turns, directions, wrap-around.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

#include "landfall/error.hpp"
#include "landfall/extended_robot.hpp"

namespace landfall {
namespace {

constexpr double deg = std::numbers::pi / 180.0;
constexpr int steps = 72;  // of 5 degrees
constexpr float none = std::numeric_limits<float>::infinity();

// One sonar on the robot's centre, 30 degrees wide, with 1 cm of noise.
std::shared_ptr<const Sensor> sonar() {
  return std::make_shared<const Sensor>(
      Sensor{.name = "sonar",
             .beams = {{.T_robot_beam = {}, .half_angle_rad = 15.0 * deg, .range_max_m = 9.0}},
             .range_noise_m = 0.01});
}

// range_m(degrees) at each heading.
std::vector<Scan> turn_of(const std::function<double(double)>& range_m) {
  std::vector<Scan> turn;
  const auto sensor = sonar();
  turn.reserve(steps);
  for (int i = 0; i < steps; ++i)
    turn.push_back({.sensor = sensor, .ranges_m = {static_cast<float>(range_m(i * 360.0 / steps))}});
  return turn;
}

double apart_deg(double a_deg, double b_deg) {
  return angle_distance(a_deg * deg, b_deg * deg) / deg;
}

struct EndPoint {
  double bearing_deg;
  double distance_m;
  int count;
};

// The distinct end points by bearing, -180 to 180, and how often each is there.
std::vector<EndPoint> end_points(const Scan& scan) {
  std::vector<EndPoint> points;
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    if (std::isnan(scan.ranges_m[i])) continue;
    const double bearing_deg = scan.sensor->beams[i].T_robot_beam.theta_rad / deg;
    const auto same = std::find_if(points.begin(), points.end(), [&](const EndPoint& point) {
      return apart_deg(point.bearing_deg, bearing_deg) < 1e-9;
    });
    if (same != points.end())
      ++same->count;
    else
      points.push_back({bearing_deg, scan.ranges_m[i], 1});
  }
  std::sort(points.begin(), points.end(),
            [](const EndPoint& a, const EndPoint& b) { return a.bearing_deg < b.bearing_deg; });
  return points;
}

// Near `distance_m` within the cone around `bearing_deg`, no echo elsewhere.
std::vector<Scan> facing(double bearing_deg, double distance_m) {
  return turn_of([=](double at_deg) { return apart_deg(at_deg, bearing_deg) <= 15.001 ? distance_m : none; });
}

TEST(TurnMinima, KeepsWhatWasMeasured) {
  const std::vector<Scan> turn = facing(40.0, 2.0);
  const Scan scan = merge_turn_minima(turn);
  ASSERT_NE(scan.measured, nullptr);
  EXPECT_EQ(scan.measured->ranges_m, merge_turn(turn).ranges_m);
  EXPECT_EQ(*scan.measured->sensor, *merge_turn(turn).sensor);
}

TEST(TurnMinima, APlateauIsOneEndPointInItsMiddle) {
  for (const double bearing_deg : {40.0, 42.5, -142.5, 0.0, -2.5}) {  // between headings; over the seam
    SCOPED_TRACE(bearing_deg);
    const std::vector<EndPoint> points = end_points(merge_turn_minima(facing(bearing_deg, 2.0)));
    ASSERT_EQ(points.size(), 1U);
    EXPECT_NEAR(apart_deg(points[0].bearing_deg, bearing_deg), 0.0, 1e-6);
    EXPECT_NEAR(points[0].distance_m, 2.0, 1e-6);
    EXPECT_EQ(points[0].count, 3);
  }
}

TEST(TurnMinima, NoiseAloneDoesNotBreakAPlateau) {
  const std::vector<double> noise_m{0.012, -0.008, 0.004, -0.015, 0.006, -0.003, 0.004};
  const Scan scan = merge_turn_minima(turn_of([&](double at_deg) {
    return at_deg >= 85.0 && at_deg <= 115.0 ? 2.0 + noise_m.at(static_cast<std::size_t>(at_deg / 5.0) - 17)
                                             : 3.0 + 0.2 * std::abs(at_deg - 100.0) / 5.0;
  }));
  std::vector<EndPoint> points = end_points(scan);
  std::erase_if(points, [](const EndPoint& point) { return point.count == 1; });
  ASSERT_EQ(points.size(), 1U);
  EXPECT_NEAR(points[0].bearing_deg, 100.0, 1e-6);
  EXPECT_NEAR(points[0].distance_m, 2.0, 0.005);
}

TEST(TurnMinima, ANarrowMinimumIsNoPlateau) {
  const std::vector<EndPoint> points = end_points(merge_turn_minima(turn_of(
      [](double at_deg) { return at_deg == 100.0 || at_deg == 105.0 ? 2.0 : 3.0 + at_deg / 100.0; })));
  EXPECT_FALSE(points.empty());
  for (const EndPoint& point : points) EXPECT_EQ(point.count, 1) << point.bearing_deg;
}

// What is nearer hides one end; the other tells where the middle is.
TEST(TurnMinima, APlateauCutOffHasItsMiddleAHalfAngleInsideTheOtherEnd) {
  const auto cut = [](double sign) {
    return turn_of([sign](double at_deg) {
      const double a = std::remainder(sign * at_deg, 360.0);
      if (std::abs(a) <= 15.0) return 2.0;
      return a > 15.0 && std::abs(a - 30.0) <= 15.0 ? 2.5 : static_cast<double>(none);
    });
  };
  for (const double sign : {1.0, -1.0}) {
    SCOPED_TRACE(sign);
    std::vector<EndPoint> points = end_points(merge_turn_minima(cut(sign)));
    std::sort(points.begin(), points.end(),
              [](const EndPoint& a, const EndPoint& b) { return a.distance_m < b.distance_m; });
    ASSERT_EQ(points.size(), 2U);
    // Beyond its open end no reading tells how far: a quarter of a step at most, so within 5 degrees.
    EXPECT_NEAR(points[0].distance_m, 2.0, 1e-6);
    EXPECT_LE(apart_deg(points[0].bearing_deg, 0.0), 5.0);
    EXPECT_NEAR(points[1].distance_m, 2.5, 1e-6);
    EXPECT_LE(apart_deg(points[1].bearing_deg, sign * 30.0), 5.0);
  }
}

TEST(TurnMinima, AWidePlateauIsTwoEndPoints) {
  const std::vector<EndPoint> points = end_points(merge_turn_minima(
      turn_of([](double at_deg) { return at_deg >= 60.0 && at_deg <= 120.0 ? 2.0 : 5.0; })));
  std::vector<double> plateau_deg;
  for (const EndPoint& point : points)
    if (point.count == 3 && point.distance_m < 3.0) plateau_deg.push_back(point.bearing_deg);
  ASSERT_EQ(plateau_deg.size(), 2U);
  EXPECT_NEAR(plateau_deg[0], 75.0, 3.0);
  EXPECT_NEAR(plateau_deg[1], 105.0, 3.0);
}

// Four lasers that look the same way, turned in four steps: the shortest, and what noise sets apart from it.
TEST(TurnMinima, OfThoseThatLookOneWayTheShortestIsKept) {
  Sensor sensor{
      .name = "four", .beams = std::vector<Beam>(4, Beam{.range_max_m = 9.0}), .range_noise_m = 0.01};
  const auto four = std::make_shared<const Sensor>(sensor);
  std::vector<Scan> turn(4, Scan{.sensor = four, .ranges_m = {none, none, none, none}});
  turn[1].ranges_m = {3.0F, 2.02F, 2.0F, none};
  turn[3].ranges_m = {NAN, 1.0F, 4.0F, 1.5F};
  const std::vector<EndPoint> points = end_points(merge_turn_minima(turn));
  ASSERT_EQ(points.size(), 2U);
  EXPECT_NEAR(points[0].bearing_deg, -90.0, 1e-9);
  EXPECT_NEAR(points[0].distance_m, 1.0, 1e-6);
  EXPECT_NEAR(points[1].bearing_deg, 90.0, 1e-9);
  EXPECT_NEAR(points[1].distance_m, 2.01, 1e-6);
  const std::vector<EndPoint> strict = end_points(merge_turn_minima(turn, {.equal_sigmas = 0.0}));
  ASSERT_EQ(strict.size(), 2U);
  EXPECT_NEAR(strict[1].distance_m, 2.0, 1e-6);
}

TEST(TurnMinima, TakesTheMountsIntoAccount) {
  Sensor sensor = *sonar();
  sensor.beams[0].T_robot_beam = {0.1, 0.05, 90.0 * deg};  // looks to the left, 5 cm along its own axis
  std::vector<Scan> turn = facing(40.0, 2.0);
  for (Scan& scan : turn) scan.sensor = std::make_shared<const Sensor>(sensor);
  const std::vector<EndPoint> points = end_points(merge_turn_minima(turn));
  ASSERT_EQ(points.size(), 1U);
  EXPECT_NEAR(points[0].bearing_deg, 130.0, 1e-6);
  EXPECT_NEAR(points[0].distance_m, 2.05, 1e-6);
}

// A sensor that looks across the robot's centre: what stands there lies in no direction from it.
TEST(TurnMinima, AnEchoInTheTurnsCentreIsNoBeam) {
  const auto inwards = std::make_shared<const Sensor>(
      Sensor{.name = "inwards", .beams = {{.T_robot_beam = {-0.5, 0.0, 0.0}, .range_max_m = 9.0}}});
  std::vector<Scan> turn(4, Scan{.sensor = inwards, .ranges_m = {3.0F}});
  turn[0].ranges_m = {0.5F};
  const Scan scan = merge_turn_minima(turn);
  EXPECT_NO_THROW(validate(scan));
  EXPECT_EQ(count_valid(scan), 3);
}

TEST(TurnMinima, NothingIsLeftOfATurnWithoutEchoes) {
  const Scan scan = merge_turn_minima(turn_of([](double) { return static_cast<double>(none); }));
  EXPECT_EQ(count_valid(scan), 0);
  EXPECT_NO_THROW(validate(scan));
}

TEST(TurnMinima, RefusesWhatDoesNotFit) {
  EXPECT_THROW((void)merge_turn_minima({}), Error);
  const std::vector<Scan> turn = facing(0.0, 2.0);
  EXPECT_THROW((void)merge_turn_minima(turn, {.equal_sigmas = -1.0}), Error);
  EXPECT_THROW((void)merge_turn_minima(turn, {.equal_sigmas = NAN}), Error);
  EXPECT_THROW((void)merge_turn_minima(turn, {.plateau_weight = -1}), Error);
  std::vector<Scan> mixed = turn;
  mixed[1].sensor = std::make_shared<const Sensor>(make_fan({.beams = 1, .range_max_m = 3.0}));
  EXPECT_THROW((void)merge_turn_minima(mixed), Error);
}

}  // namespace
}  // namespace landfall
