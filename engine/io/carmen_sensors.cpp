#include "engine/io/carmen_sensors.hpp"

#include <cmath>
#include <numbers>

namespace landfall::io {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double laser_noise_m = 0.02;  // SICK LMS: 1 cm steps, and mixed returns at edges
constexpr double sonar_noise_m = 0.03;
constexpr double sonar_noise_relative = 0.01;

double read_value(std::string_view word, std::string_view name, const Place& place) {
  const std::optional<double> value = parse_number(word);
  if (!value || !std::isfinite(*value))
    fail_format(place, name, word.empty() ? "nothing" : shown(word), "a finite number");
  return *value;
}

double read_positive(std::string_view word, std::string_view name, const Place& place) {
  const double value = read_value(word, name, place);
  if (!(value > 0.0)) fail_format(place, name, shown(word), "a positive number");
  return value;
}

// "laser_front_laser_resolution" for `front`: true where the parameter was this laser's.
bool read_laser(CarmenLaser& laser, std::string_view name, std::string_view word, const Place& place) {
  const std::string side = laser.rear ? "rear" : "front";
  if (name == "robot_" + side + "_laser_max") {
    laser.range_max_m = read_positive(word, name, place);
  } else if (name == "laser_" + side + "_laser_resolution") {
    laser.resolution_deg = read_positive(word, name, place);
  } else if (name == "robot_" + side + "laser_offset") {
    laser.offset_m = read_value(word, name, place);
  } else if (name == "robot_" + side + "laser_side_offset") {
    laser.side_offset_m = read_value(word, name, place);
  } else if (name == "robot_" + side + "laser_angular_offset") {
    laser.angular_offset_rad = read_value(word, name, place);
  } else {
    return false;
  }
  return true;
}

// x y theta of each sonar, until the first word that is no number or the one time stamp that is left.
std::vector<Pose2> read_sonar_offsets(Words words) {
  std::vector<double> values;
  for (std::optional<double> value = parse_number(words.next()); value && std::isfinite(*value);
       value = parse_number(words.next()))
    values.push_back(*value);
  std::vector<Pose2> T_robot_sonar;
  for (std::size_t i = 0; i + 2 < values.size(); i += 3)
    T_robot_sonar.push_back({.x_m = values[i], .y_m = values[i + 1], .theta_rad = values[i + 2]});
  return T_robot_sonar;
}

template <typename Make>
std::shared_ptr<const Sensor> checked(Make make, const Place& place) {
  try {
    Sensor sensor = make();
    validate(sensor);
    return std::make_shared<const Sensor>(std::move(sensor));
  } catch (const Error& error) {
    throw Error(ErrorCode::file_format, to_string(place) + ": " + error.what());
  }
}

}  // namespace

Pose2 T_robot_laser(const CarmenLaser& laser) {
  if (!laser.offset_m && laser.mount_of_poses) return *laser.mount_of_poses;
  // Logs give the rear laser's offset with either sign: it is behind the centre.
  const double offset_m = laser.offset_m.value_or(0.0);
  return {.x_m = laser.rear ? -std::abs(offset_m) : offset_m,
          .y_m = laser.side_offset_m,
          .theta_rad = laser.angular_offset_rad.value_or(laser.rear ? pi : 0.0)};
}

double guess_step_rad(int beams) {
  if (beams == 180 || beams == 181) return pi / 180.0;
  if (beams == 360 || beams == 361) return pi / 360.0;
  if (beams == 400 || beams == 401) return pi / 720.0;
  return beams > 1 ? pi / (beams - 1) : 0.0;
}

void CarmenParams::read(Words words, const Place& place) {
  const std::string_view name = words.next();
  const Words values = words;
  const std::string_view word = words.next();
  if (read_laser(front, name, word, place) || read_laser(rear, name, word, place)) return;
  if (name == "robot_max_sonar") sonar_max_m = read_positive(word, name, place);
  if (name == "robot_sonar_offsets") T_robot_sonar = read_sonar_offsets(values);
}

std::shared_ptr<const Sensor> CarmenSensors::replacement(const std::string& name, std::size_t beams,
                                                         const Place& place) const {
  const auto found = replacements_.find(name);
  if (found == replacements_.end() || !found->second) return nullptr;
  if (found->second->beams.size() != beams)
    fail_format(place, "number of readings", std::to_string(beams),
                std::to_string(found->second->beams.size()) + " as sensor '" + name + "' has beams");
  return found->second;
}

std::shared_ptr<const Sensor> CarmenSensors::fan(const FanOptions& fan, const Place& place) {
  auto given = replacement(fan.name, static_cast<std::size_t>(fan.beams), place);
  if (given) return given;
  const Pose2& mount = fan.T_robot_sensor;
  auto& sensor = made_[fan.name][{static_cast<double>(fan.beams), fan.first_rad, fan.step_rad, mount.x_m,
                                  mount.y_m, mount.theta_rad, fan.range_max_m}];
  if (!sensor) {
    FanOptions options = fan;
    options.range_noise_m = laser_noise_m;
    sensor = checked([&] { return make_fan(options); }, place);
  }
  return sensor;
}

std::shared_ptr<const Sensor> CarmenSensors::sonar_ring(const std::vector<Pose2>& T_robot_sonar,
                                                        double half_angle_rad, double range_max_m,
                                                        const Place& place) {
  auto given = replacement("sonar", T_robot_sonar.size(), place);
  if (given) return given;
  std::vector<double> key = {half_angle_rad, range_max_m};
  for (const Pose2& mount : T_robot_sonar) key.insert(key.end(), {mount.x_m, mount.y_m, mount.theta_rad});
  auto& sensor = made_["sonar"][key];
  if (!sensor) {
    Sensor ring{.name = "sonar",
                .beams = {},
                .range_noise_m = sonar_noise_m,
                .range_noise_relative = sonar_noise_relative};
    for (const Pose2& mount : T_robot_sonar)
      ring.beams.push_back(
          {.T_robot_beam = mount, .half_angle_rad = half_angle_rad, .range_max_m = range_max_m});
    sensor = checked([&] { return ring; }, place);
  }
  return sensor;
}

}  // namespace landfall::io
