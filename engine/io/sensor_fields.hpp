// A sensor as fields of a JSON or YAML document: `name`, `range_noise_m`, `range_noise_relative`, and
// `beams` (a list) or `fan` (the shorthand for evenly spaced beams).
#pragma once

#include <string>

#include "engine/io/document.hpp"
#include "landfall/sensor.hpp"

namespace landfall::io {

Sensor read_sensor(const Field& field);
// What the fans of one file may hold together: a line of a few words can ask for a million beams.
class FanBudget {
 public:
  // `sensor` is what was read from the field. Throws Error{too_large} where the file asks for too many.
  void spend(const Field& field, const Sensor& sensor);

 private:
  std::size_t beams_left_ = 10'000'000;
};
// On one line; also valid as YAML. A fan where that gives every beam back bit for bit.
std::string to_json(const Sensor& sensor);
std::string json_text(const std::string& text);         // in quotes, escaped
void append_pose(std::string& out, const Pose2& pose);  // [x, y, theta]

}  // namespace landfall::io
