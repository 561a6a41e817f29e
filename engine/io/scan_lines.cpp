// Scan lines (.jsonl): a JSON object a line, either a sensor {"sensor": {"name": ...}} or a scan
// {"stamp_s": ..., "sensor": "name", "ranges_m": [...]}.
#include <cmath>
#include <map>

#include "engine/io/document.hpp"
#include "engine/io/file.hpp"
#include "engine/io/readers.hpp"
#include "engine/io/sensor_fields.hpp"
#include "engine/io/text.hpp"

namespace landfall {
namespace io {
namespace {

std::shared_ptr<const Sensor> find_sensor(const SensorsByName& sensors, const Field& scan) {
  const Field name = scan.at("sensor");
  const auto found = sensors.find(name.text());
  if (found == sensors.end() || !found->second) name.fail("a sensor that a line before this one defines");
  return found->second;
}

Scan read_scan(const SensorsByName& sensors, const Field& field) {
  Scan scan;
  scan.sensor = find_sensor(sensors, field);
  scan.ranges_m = field.at("ranges_m").ranges();
  if (scan.ranges_m.size() != scan.sensor->beams.size())
    field.at("ranges_m")
        .fail(std::to_string(scan.sensor->beams.size()) + " ranges, as sensor '" + scan.sensor->name +
              "' has beams");
  scan.stamp_s = field.at("stamp_s").number();
  if (const auto pose = field.find("T_odom_robot")) scan.T_odom_robot = pose->pose();
  if (const auto pose = field.find("T_map_robot")) scan.T_map_robot = pose->pose();
  return scan;
}

// JSON has no infinity: a beam that hit nothing is written as its sensor's maximum.
void append_range(std::string& out, float range_m, const Beam& beam) {
  if (std::isnan(range_m) || range_m < 0.0f) {
    out += "null";
  } else if (std::isinf(range_m)) {
    append_number(out, beam.range_max_m);
  } else {
    append_number(out, range_m);
  }
}

std::string to_line(const Scan& scan) {
  std::string line = "{\"stamp_s\": ";
  append_number(line, scan.stamp_s);
  line += ", \"sensor\": " + json_text(scan.sensor->name) + ", \"ranges_m\": [";
  for (std::size_t b = 0; b < scan.ranges_m.size(); ++b) {
    if (b > 0) line += ", ";
    append_range(line, scan.ranges_m[b], scan.sensor->beams[b]);
  }
  line += ']';
  if (scan.T_odom_robot) append_pose(line += ", \"T_odom_robot\": ", *scan.T_odom_robot);
  if (scan.T_map_robot) append_pose(line += ", \"T_map_robot\": ", *scan.T_map_robot);
  return line + "}\n";
}

}  // namespace

Log read_scan_lines(const LogSource& source, const LoadLogOptions& options) {
  SensorsByName sensors = options.sensors;
  FanBudget budget;
  Log log;
  Lines lines(source.text);
  for (std::string_view line; lines.next(line);) {
    if (Words(line).next().empty()) continue;
    const Document document = Document::from_json(line, {source.file, lines.number()});
    const Field root = document.root();
    if (!root.at("sensor").is_object()) {
      log.scans.push_back(read_scan(sensors, root));
      continue;
    }
    root.expect_only({"sensor"});
    Sensor sensor = read_sensor(root.at("sensor"));
    if (options.sensors.contains(sensor.name)) continue;
    std::shared_ptr<const Sensor>& known = sensors[sensor.name];
    if (known && *known == sensor) continue;  // logs may say it again before each scan
    budget.spend(root.at("sensor"), sensor);
    known = std::make_shared<const Sensor>(std::move(sensor));
  }
  return log;
}

}  // namespace io

void save_log(std::span<const Scan> scans, const std::filesystem::path& jsonl) {
  std::string text;
  std::map<std::string, std::shared_ptr<const Sensor>> written;  // a name may come to mean another sensor
  for (const Scan& scan : scans) {
    validate(scan);
    std::shared_ptr<const Sensor>& last = written[scan.sensor->name];
    if (last != scan.sensor && (!last || *last != *scan.sensor))
      text += "{\"sensor\": " + io::to_json(*scan.sensor) + "}\n";
    last = scan.sensor;
    text += io::to_line(scan);
  }
  io::write_file(jsonl, jsonl.extension() == ".gz" ? io::gzip(text) : text);
}

}  // namespace landfall
