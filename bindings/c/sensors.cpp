#include <numbers>
#include <utility>

#include "bindings/c/handles.hpp"
#include "landfall/io.hpp"

namespace {

using landfall::c::array;
using landfall::c::from_c;
using landfall::c::guarded;
using landfall::c::required;

landfall_sensor* make_handle(landfall::Sensor sensor) {
  validate(sensor);
  return new landfall_sensor{std::make_shared<const landfall::Sensor>(std::move(sensor))};
}

std::shared_ptr<const landfall::Sensor> load_sensor(const char* path, const char* name) {
  const auto sensors = landfall::load_sensors(path);
  if (name == nullptr && sensors.size() != 1)
    landfall::c::refuse(std::string(path) + " defines " + std::to_string(sensors.size()) +
                        " sensors, expected a name or a file with one");
  const auto found = name == nullptr ? sensors.begin() : sensors.find(name);
  if (found == sensors.end())
    throw landfall::Error(landfall::ErrorCode::unknown_name,
                          std::string(path) + " defines no sensor \"" + name + "\"");
  return found->second;
}

}  // namespace

landfall_status landfall_sensor_from_beams(const landfall_beam* beams, size_t beam_count,
                                           double range_noise_m, double range_noise_relative,
                                           landfall_sensor** sensor) {
  return guarded(__func__, [&] {
    auto*& made = required(sensor, "sensor");
    landfall::Sensor source{.name = "sensor",
                            .beams = {},
                            .range_noise_m = range_noise_m,
                            .range_noise_relative = range_noise_relative};
    for (const landfall_beam& beam : array(beams, beam_count, "beams"))
      source.beams.push_back({.T_robot_beam = from_c(beam.T_robot_beam),
                              .half_angle_rad = beam.half_angle_rad,
                              .range_min_m = beam.range_min_m,
                              .range_max_m = beam.range_max_m});
    made = make_handle(std::move(source));
  });
}

void landfall_fan_options_init(landfall_fan_options* options) {
  if (options == nullptr) return;
  const landfall::FanOptions defaults;
  *options = {.struct_size = sizeof(landfall_fan_options),
              .beam_count = defaults.beams,
              .first_rad = -std::numbers::pi / 2.0,
              .step_rad = std::numbers::pi / 180.0,
              .T_robot_sensor = {},
              .half_angle_rad = defaults.half_angle_rad,
              .range_min_m = defaults.range_min_m,
              .range_max_m = defaults.range_max_m,
              .range_noise_m = defaults.range_noise_m,
              .range_noise_relative = defaults.range_noise_relative};
}

landfall_status landfall_sensor_fan(const landfall_fan_options* options, landfall_sensor** sensor) {
  return guarded(__func__, [&] {
    auto*& made = required(sensor, "sensor");
    const landfall_fan_options fan = landfall::c::or_defaults(options, landfall_fan_options_init);
    made = make_handle(landfall::make_fan({.name = "laser",
                                           .beams = fan.beam_count,
                                           .first_rad = fan.first_rad,
                                           .step_rad = fan.step_rad,
                                           .T_robot_sensor = from_c(fan.T_robot_sensor),
                                           .half_angle_rad = fan.half_angle_rad,
                                           .range_min_m = fan.range_min_m,
                                           .range_max_m = fan.range_max_m,
                                           .range_noise_m = fan.range_noise_m,
                                           .range_noise_relative = fan.range_noise_relative}));
  });
}

landfall_status landfall_sensor_load(const char* path, const char* name, landfall_sensor** sensor) {
  return guarded(__func__, [&] {
    auto*& made = required(sensor, "sensor");
    made = new landfall_sensor{load_sensor(&required(path, "path"), name)};
  });
}

size_t landfall_sensor_beam_count(const landfall_sensor* sensor) {
  return sensor == nullptr ? 0 : sensor->sensor->beams.size();
}

void landfall_sensor_free(landfall_sensor* sensor) {
  delete sensor;
}
