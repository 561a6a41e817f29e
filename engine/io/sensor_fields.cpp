#include "engine/io/sensor_fields.hpp"

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <optional>

#include "engine/io/text.hpp"

namespace landfall::io {
namespace {

Pose2 read_mount(const Field& field, std::string_view key) {
  const std::optional<Field> mount = field.find(key);
  return mount ? mount->pose() : Pose2{};
}

Beam read_beam(const Field& field) {
  field.expect_only({"T_robot_beam", "half_angle_rad", "range_min_m", "range_max_m"});
  return {.T_robot_beam = field.at("T_robot_beam").pose(),
          .half_angle_rad = field.number_or("half_angle_rad", 0.0),
          .range_min_m = field.number_or("range_min_m", 0.0),
          .range_max_m = field.at("range_max_m").number()};
}

std::vector<Beam> read_fan(const Field& field) {
  field.expect_only(
      {"beams", "first_rad", "step_rad", "T_robot_sensor", "half_angle_rad", "range_min_m", "range_max_m"});
  return make_fan({.beams = field.at("beams").integer(1, 1'000'000),
                   .first_rad = field.at("first_rad").number(),
                   .step_rad = field.at("step_rad").number(),
                   .T_robot_sensor = read_mount(field, "T_robot_sensor"),
                   .half_angle_rad = field.number_or("half_angle_rad", 0.0),
                   .range_min_m = field.number_or("range_min_m", 0.0),
                   .range_max_m = field.at("range_max_m").number()})
      .beams;
}

// Steps that a fan of these beams may have been made with: as printed in degrees, or what the beams say.
std::vector<double> candidate_steps(const std::vector<Beam>& beams) {
  const double span_rad = beams.back().T_robot_beam.theta_rad - beams.front().T_robot_beam.theta_rad;
  const double mean_rad = span_rad / static_cast<double>(beams.size() - 1);
  const double first_rad = beams[1].T_robot_beam.theta_rad - beams[0].T_robot_beam.theta_rad;
  const double degrees = std::round(first_rad * 180.0 / std::numbers::pi * 1e6) / 1e6;
  std::vector<double> steps = {degrees * std::numbers::pi / 180.0, degrees * (std::numbers::pi / 180.0)};
  for (const double step : {mean_rad, first_rad})
    for (const double candidate : {step, std::nextafter(step, -4.0), std::nextafter(step, 4.0)})
      steps.push_back(candidate);
  return steps;
}

std::optional<FanOptions> as_fan(const Sensor& sensor) {
  if (sensor.beams.size() < 3) return std::nullopt;
  const Beam& first = sensor.beams[0];
  FanOptions fan{.beams = static_cast<int>(sensor.beams.size()),
                 .first_rad = first.T_robot_beam.theta_rad,
                 .T_robot_sensor = {.x_m = first.T_robot_beam.x_m, .y_m = first.T_robot_beam.y_m},
                 .half_angle_rad = first.half_angle_rad,
                 .range_min_m = first.range_min_m,
                 .range_max_m = first.range_max_m};
  for (const double step_rad : candidate_steps(sensor.beams)) {
    fan.step_rad = step_rad;
    if (make_fan(fan).beams == sensor.beams) return fan;
  }
  return std::nullopt;
}

void append_member(std::string& out, const char* key, double value) {
  out.append(", \"").append(key).append("\": ");
  append_number(out, value);
}

void append_limits(std::string& out, double half_angle_rad, double range_min_m, double range_max_m) {
  append_member(out, "half_angle_rad", half_angle_rad);
  append_member(out, "range_min_m", range_min_m);
  append_member(out, "range_max_m", range_max_m);
}

void append_fan(std::string& out, const FanOptions& fan) {
  out += "\"fan\": {\"beams\": " + std::to_string(fan.beams);
  append_member(out, "first_rad", fan.first_rad);
  append_member(out, "step_rad", fan.step_rad);
  out += ", \"T_robot_sensor\": ";
  append_pose(out, fan.T_robot_sensor);
  append_limits(out, fan.half_angle_rad, fan.range_min_m, fan.range_max_m);
  out += '}';
}

void append_beams(std::string& out, const std::vector<Beam>& beams) {
  out += "\"beams\": [";
  const char* separator = "";
  for (const Beam& beam : beams) {
    out.append(separator).append("{\"T_robot_beam\": ");
    separator = ", ";
    append_pose(out, beam.T_robot_beam);
    append_limits(out, beam.half_angle_rad, beam.range_min_m, beam.range_max_m);
    out += '}';
  }
  out += ']';
}

}  // namespace

std::string json_text(const std::string& text) {
  return nlohmann::json(text).dump(-1, ' ', true, nlohmann::json::error_handler_t::replace);
}

void append_pose(std::string& out, const Pose2& pose) {
  const char* bracket = "[";
  for (const double value : {pose.x_m, pose.y_m, pose.theta_rad}) {
    out += bracket;
    bracket = ", ";
    append_number(out, value);
  }
  out += ']';
}

Sensor read_sensor(const Field& field) {
  field.expect_only({"name", "beams", "fan", "range_noise_m", "range_noise_relative"});
  const std::optional<Field> beams = field.find("beams");
  const std::optional<Field> fan = field.find("fan");
  if (beams.has_value() == fan.has_value()) field.fail("either beams or fan");
  Sensor sensor;
  sensor.name = field.at("name").text();
  sensor.range_noise_m = field.number_or("range_noise_m", sensor.range_noise_m);
  sensor.range_noise_relative = field.number_or("range_noise_relative", sensor.range_noise_relative);
  try {
    if (fan) sensor.beams = read_fan(*fan);
    if (beams)
      for (const Field& beam : beams->items()) sensor.beams.push_back(read_beam(beam));
    validate(sensor);
  } catch (const Error& error) {
    if (error.code() == ErrorCode::file_format) throw;
    throw Error(ErrorCode::file_format, to_string(field.place()) + ": " + error.what());
  }
  return sensor;
}

void FanBudget::spend(const Field& field, const Sensor& sensor) {
  if (!field.find("fan")) return;  // a list has as many beams as the file has room for
  if (sensor.beams.size() > beams_left_)
    fail_format(field.place(), "fan.beams",
                std::to_string(sensor.beams.size()) + " on top of those of other sensors",
                "at most " + std::to_string(beams_left_), ErrorCode::too_large);
  beams_left_ -= sensor.beams.size();
}

std::string to_json(const Sensor& sensor) {
  std::string text = "{\"name\": " + json_text(sensor.name);
  append_member(text, "range_noise_m", sensor.range_noise_m);
  append_member(text, "range_noise_relative", sensor.range_noise_relative);
  text += ", ";
  if (const std::optional<FanOptions> fan = as_fan(sensor)) {
    append_fan(text, *fan);
  } else {
    append_beams(text, sensor.beams);
  }
  return text + "}";
}

}  // namespace landfall::io
