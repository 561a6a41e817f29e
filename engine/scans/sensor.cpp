#include "landfall/sensor.hpp"

#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>

#include "engine/base/number_text.hpp"
#include "landfall/error.hpp"

namespace landfall {
namespace {

constexpr std::size_t max_beams = 1'000'000;

[[noreturn]] void fail(const Sensor& sensor, const std::string& what) {
  throw Error(ErrorCode::invalid_argument, "sensor '" + sensor.name + "': " + what);
}

void validate_noise(const Sensor& sensor, const char* field, double value) {
  if (!std::isfinite(value) || value < 0.0)
    fail(sensor, std::string(field) + " is " + number_text(value) + ", expected a finite number >= 0");
}

void validate_beam(const Sensor& sensor, std::size_t index) {
  const Beam& beam = sensor.beams[index];
  const auto fail_beam = [&](const char* field, double value, const char* expected) {
    fail(sensor, "beam " + std::to_string(index) + ": " + field + " is " + number_text(value) +
                     ", expected " + expected);
  };
  const Pose2& mount = beam.T_robot_beam;
  if (!std::isfinite(mount.x_m)) fail_beam("T_robot_beam.x_m", mount.x_m, "a finite number");
  if (!std::isfinite(mount.y_m)) fail_beam("T_robot_beam.y_m", mount.y_m, "a finite number");
  if (!std::isfinite(mount.theta_rad))
    fail_beam("T_robot_beam.theta_rad", mount.theta_rad, "a finite number");
  if (!(beam.half_angle_rad >= 0.0 && beam.half_angle_rad < std::numbers::pi))
    fail_beam("half_angle_rad", beam.half_angle_rad, "0 <= half-angle < pi");
  if (!std::isfinite(beam.range_min_m) || beam.range_min_m < 0.0)
    fail_beam("range_min_m", beam.range_min_m, "a finite number >= 0");
  if (!std::isfinite(beam.range_max_m) || beam.range_max_m <= beam.range_min_m)
    fail_beam("range_max_m", beam.range_max_m, "a finite number above range_min_m");
}

}  // namespace

Sensor make_fan(const FanOptions& options) {
  if (options.beams <= 0 || static_cast<std::size_t>(options.beams) > max_beams)
    throw Error(ErrorCode::invalid_argument, "fan '" + options.name + "': beams is " +
                                                 std::to_string(options.beams) + ", expected 1 to " +
                                                 std::to_string(max_beams));
  Sensor sensor{.name = options.name,
                .beams = {},
                .range_noise_m = options.range_noise_m,
                .range_noise_relative = options.range_noise_relative};
  sensor.beams.reserve(static_cast<std::size_t>(options.beams));
  for (int i = 0; i < options.beams; ++i) {
    const Pose2 T_sensor_beam{.x_m = 0.0, .y_m = 0.0, .theta_rad = options.first_rad + i * options.step_rad};
    sensor.beams.push_back({.T_robot_beam = options.T_robot_sensor * T_sensor_beam,
                            .half_angle_rad = options.half_angle_rad,
                            .range_min_m = options.range_min_m,
                            .range_max_m = options.range_max_m});
  }
  validate(sensor);
  return sensor;
}

void validate(const Sensor& sensor) {
  if (sensor.beams.empty()) fail(sensor, "no beams, expected at least one");
  if (sensor.beams.size() > max_beams)
    fail(sensor,
         std::to_string(sensor.beams.size()) + " beams, at most " + std::to_string(max_beams) + " are taken");
  validate_noise(sensor, "range_noise_m", sensor.range_noise_m);
  validate_noise(sensor, "range_noise_relative", sensor.range_noise_relative);
  for (std::size_t i = 0; i < sensor.beams.size(); ++i) validate_beam(sensor, i);
}

}  // namespace landfall
