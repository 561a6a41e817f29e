// Espino et al., section 3.2, over the readings of all sonars together: what counts as a neighbour, and what
// is done with plateaus, is ours.
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <string>

#include "engine/base/number_text.hpp"
#include "engine/scans/turn_plateaus.hpp"
#include "engine/scans/turn_readings.hpp"
#include "landfall/error.hpp"
#include "landfall/extended_robot.hpp"

namespace landfall {
namespace {

using internal::TurnReading;

void check(std::span<const Scan> turn, const TurnMinimaOptions& options) {
  if (turn.empty()) throw Error(ErrorCode::invalid_argument, "turn: no scans, expected at least one");
  internal::check_turn(turn);
  if (!(options.equal_sigmas >= 0.0) || !std::isfinite(options.equal_sigmas))
    throw Error(ErrorCode::invalid_argument,
                "turn: equal_sigmas is " + number_text(options.equal_sigmas) + ", expected a number >= 0");
  if (options.plateau_weight < 0 || options.plateau_weight > 100)
    throw Error(ErrorCode::invalid_argument,
                "turn: plateau_weight is " + number_text(options.plateau_weight) + ", expected 0 to 100");
}

Point2 end_point(const TurnReading& reading) {
  return {reading.mount.x_m + reading.range_m * std::cos(reading.bearing_rad),
          reading.mount.y_m + reading.range_m * std::sin(reading.bearing_rad)};
}

// The mean end point of reading i and those within half a step to either side that noise alone sets apart
// from it; nothing where one of them is shorter than it.
bool mean_of_direction(std::span<const TurnReading> readings, std::size_t i, double half_step_rad,
                       double equal_sigmas, Point2& mean) {
  const TurnReading& shortest = readings[i];
  mean = end_point(shortest);
  double count = 1.0;
  for (const std::size_t step : {std::size_t{1}, readings.size() - 1})
    for (std::size_t j = (i + step) % readings.size(); j != i; j = (j + step) % readings.size()) {
      if (angle_distance(readings[j].bearing_rad, shortest.bearing_rad) > half_step_rad) break;
      const double longer_m = readings[j].foot_m - shortest.foot_m;
      if (longer_m < 0.0 || (longer_m == 0.0 && j < i)) return false;
      if (longer_m > equal_sigmas * shortest.noise_m) continue;
      const Point2 equal = end_point(readings[j]);
      mean = {mean.x_m + equal.x_m, mean.y_m + equal.y_m};
      count += 1.0;
    }
  mean = {mean.x_m / count, mean.y_m / count};
  return true;
}

// Beams from the turn's centre that end at these points.
Scan scan_of(const std::vector<Point2>& end_points, const Scan& first) {
  auto sensor = std::make_shared<Sensor>(Sensor{.name = first.sensor->name + ", turned",
                                                .range_noise_m = first.sensor->range_noise_m,
                                                .range_noise_relative = first.sensor->range_noise_relative});
  Scan scan{.stamp_s = first.stamp_s, .T_odom_robot = first.T_odom_robot, .T_map_robot = first.T_map_robot};
  for (const Point2& p_robot : end_points) {
    const double range_m = std::hypot(p_robot.x_m, p_robot.y_m);
    if (!(static_cast<float>(range_m) > 0.0F)) continue;  // in the centre: no beam from there ends in it
    sensor->beams.push_back(
        {.T_robot_beam = {0.0, 0.0, std::atan2(p_robot.y_m, p_robot.x_m)}, .range_max_m = 2.0 * range_m});
    scan.ranges_m.push_back(static_cast<float>(range_m));
  }
  // A scan has a beam at least: one that reads nothing.
  if (sensor->beams.empty()) {
    sensor->beams.emplace_back();
    scan.ranges_m.push_back(std::numeric_limits<float>::quiet_NaN());
  }
  scan.sensor = std::move(sensor);
  return scan;
}

}  // namespace

Scan merge_turn_minima(std::span<const Scan> turn, const TurnMinimaOptions& options) {
  check(turn, options);
  const double step_rad = 2.0 * std::numbers::pi / static_cast<double>(turn.size());
  const std::vector<TurnReading> readings = internal::interleaved_readings(turn);
  const internal::TurnPlateaus plateaus =
      internal::find_plateaus(readings, {.equal_sigmas = options.equal_sigmas,
                                         .slack_m = internal::foot_slack_m(*turn[0].sensor),
                                         .turn_step_rad = step_rad});
  std::vector<Point2> end_points;
  for (const internal::FacingPoint& point : plateaus.points)
    end_points.insert(end_points.end(), static_cast<std::size_t>(options.plateau_weight),
                      Pose2{0.0, 0.0, point.bearing_rad} * Point2{point.distance_m, 0.0});
  for (std::size_t i = 0; i < readings.size(); ++i) {
    Point2 mean;
    if (plateaus.taken[i] || !std::isfinite(readings[i].range_m)) continue;
    if (mean_of_direction(readings, i, 0.5 * step_rad, options.equal_sigmas, mean))
      end_points.push_back(mean);
  }
  Scan scan = scan_of(end_points, turn[0]);
  scan.measured = std::make_shared<const Scan>(merge_turn(turn));
  return scan;
}

}  // namespace landfall
