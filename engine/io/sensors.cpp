// Sensor files: yaml with one sensor at the top, or several under `sensors`; the sensor lines of a log.
#include <memory>

#include "engine/io/file.hpp"
#include "engine/io/readers.hpp"
#include "engine/io/sensor_fields.hpp"
#include "engine/io/text.hpp"

namespace landfall {
namespace io {
namespace {

void add(SensorsByName& sensors, const Field& field, FanBudget& budget) {
  const Sensor sensor = read_sensor(field);
  budget.spend(field, sensor);
  if (!sensors.emplace(sensor.name, std::make_shared<const Sensor>(sensor)).second)
    field.at("name").fail("a name that is not taken yet");
}

}  // namespace

SensorsByName read_sensors_yaml(std::string_view yaml, const std::string& file) {
  const Document document = Document::from_yaml(yaml, file);
  const Field root = document.root();
  SensorsByName sensors;
  FanBudget budget;
  if (const std::optional<Field> list = root.find("sensors")) {
    root.expect_only({"sensors"});
    for (const Field& field : list->items()) add(sensors, field, budget);
    if (sensors.empty()) list->fail("at least one sensor");
  } else {
    add(sensors, root, budget);
  }
  return sensors;
}

SensorsByName read_sensor_lines(std::string_view jsonl, const std::string& file) {
  SensorsByName sensors;
  FanBudget budget;
  Lines lines(jsonl);
  for (std::string_view line; lines.next(line);) {
    if (Words(line).next().empty()) continue;
    const Document document = Document::from_json(line, {file, lines.number()});
    const std::optional<Field> sensor = document.root().find("sensor");
    if (!sensor || !sensor->is_object()) continue;
    const Sensor read = read_sensor(*sensor);
    std::shared_ptr<const Sensor>& known = sensors[read.name];
    if (known && *known == read) continue;  // logs may say it again before each scan
    budget.spend(*sensor, read);
    known = std::make_shared<const Sensor>(read);
  }
  if (sensors.empty()) fail_format({file}, "", "no sensor line", "at least one");
  return sensors;
}

}  // namespace io

std::map<std::string, std::shared_ptr<const Sensor>> load_sensors(const std::filesystem::path& path) {
  const std::string extension = io::text_extension(path);
  if (extension == ".yaml" || extension == ".yml")
    return io::read_sensors_yaml(io::read_file(path), path.string());
  if (extension == ".jsonl") return io::read_sensor_lines(io::read_text_file(path), path.string());
  io::fail_format({path.string()}, "", "ending " + io::shown(extension), ".yaml, .yml, .jsonl or .jsonl.gz");
}

void save_sensor(const Sensor& sensor, const std::filesystem::path& yaml) {
  validate(sensor);
  io::write_file(yaml, io::to_json(sensor) + "\n");
}

}  // namespace landfall
