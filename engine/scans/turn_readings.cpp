#include "engine/scans/turn_readings.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "landfall/error.hpp"

namespace landfall::internal {
namespace {

constexpr double full_turn_rad = 2.0 * std::numbers::pi;

// Of a beam's mount: how far along its own axis it lies, and how far beside it.
struct MountOffset {
  double along_m = 0.0;
  double beside_m = 0.0;
};

MountOffset offset_of(const Pose2& T_robot_beam) {
  const double cos_axis = std::cos(T_robot_beam.theta_rad);
  const double sin_axis = std::sin(T_robot_beam.theta_rad);
  return {.along_m = T_robot_beam.x_m * cos_axis + T_robot_beam.y_m * sin_axis,
          .beside_m = T_robot_beam.y_m * cos_axis - T_robot_beam.x_m * sin_axis};
}

TurnReading reading_of(const Sensor& sensor, const Beam& beam, float range_m, double turned_rad) {
  const bool echo = classify(beam, range_m) == Reading::echo;
  const double range = echo ? range_m : std::numeric_limits<double>::infinity();
  const Pose2 T_first_beam = Pose2{0.0, 0.0, turned_rad} * beam.T_robot_beam;
  return {.bearing_rad = positive_angle(T_first_beam.theta_rad),
          .mount = {T_first_beam.x_m, T_first_beam.y_m},
          .range_m = range,
          .foot_m = range + offset_of(beam.T_robot_beam).along_m,
          .noise_m = sensor.range_noise_m + (echo ? sensor.range_noise_relative * range : 0.0),
          .half_angle_rad = beam.half_angle_rad};
}

}  // namespace

void check_turn(std::span<const Scan> turn) {
  for (std::size_t i = 0; i < turn.size(); ++i) {
    validate(turn[i]);
    if (turn[i].sensor != turn[0].sensor && !(*turn[i].sensor == *turn[0].sensor))
      throw Error(ErrorCode::invalid_argument, "turn: scan " + std::to_string(i) + " is of sensor '" +
                                                   turn[i].sensor->name + "', expected the first scan's");
  }
}

std::vector<TurnReading> interleaved_readings(std::span<const Scan> turn) {
  std::vector<TurnReading> readings;
  for (std::size_t i = 0; i < turn.size(); ++i) {
    const Sensor& sensor = *turn[i].sensor;
    const double turned_rad = full_turn_rad * static_cast<double>(i) / static_cast<double>(turn.size());
    for (std::size_t b = 0; b < sensor.beams.size(); ++b) {
      const float range_m = turn[i].ranges_m[b];
      if (classify(sensor.beams[b], range_m) != Reading::invalid)
        readings.push_back(reading_of(sensor, sensor.beams[b], range_m, turned_rad));
    }
  }
  std::stable_sort(readings.begin(), readings.end(),
                   [](const TurnReading& a, const TurnReading& b) { return a.bearing_rad < b.bearing_rad; });
  return readings;
}

double foot_slack_m(const Sensor& sensor) {
  double slack_m = 0.0;
  for (const Beam& beam : sensor.beams) {
    const MountOffset offset = offset_of(beam.T_robot_beam);
    slack_m = std::max(slack_m, std::abs(offset.beside_m) * std::sin(beam.half_angle_rad) +
                                    std::abs(offset.along_m) * (1.0 - std::cos(beam.half_angle_rad)));
  }
  return slack_m;
}

double positive_angle(double angle_rad) {
  const double wrapped = std::fmod(angle_rad, full_turn_rad);
  return wrapped < 0.0 ? wrapped + full_turn_rad : wrapped;
}

}  // namespace landfall::internal
