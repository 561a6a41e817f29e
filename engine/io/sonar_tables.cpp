// Two published tables of sonar readings. Neither states its sensors: what is assumed here is in
// docs/formats.md.
#include <array>
#include <cmath>
#include <numbers>
#include <unordered_map>

#include "engine/io/file.hpp"
#include "engine/io/place.hpp"
#include "engine/io/readers.hpp"
#include "engine/io/text.hpp"

namespace landfall::io {
namespace {

constexpr double degree_rad = std::numbers::pi / 180.0;
constexpr double half_angle_rad = 12.5 * degree_rad;
constexpr std::size_t corridor8_sonars = 8;
constexpr std::size_t scitos24_sonars = 24;

std::shared_ptr<const Sensor> make_ring(const std::string& name, std::span<const double> bearings_rad,
                                        double radius_m, double range_max_m) {
  Sensor sensor{.name = name, .beams = {}, .range_noise_m = 0.03, .range_noise_relative = 0.01};
  for (const double bearing_rad : bearings_rad)
    sensor.beams.push_back({.T_robot_beam = {.x_m = radius_m * std::cos(bearing_rad),
                                             .y_m = radius_m * std::sin(bearing_rad),
                                             .theta_rad = wrap_angle(bearing_rad)},
                            .half_angle_rad = half_angle_rad,
                            .range_max_m = range_max_m});
  return std::make_shared<const Sensor>(std::move(sensor));
}

std::shared_ptr<const Sensor> corridor8_sensor() {
  std::array<double, corridor8_sonars> bearings_rad = {-90, -50, -30, -10, 10, 30, 50, 90};
  for (double& bearing_rad : bearings_rad) bearing_rad *= degree_rad;
  return make_ring("corridor8", bearings_rad, 0.2, 5.11);
}

std::shared_ptr<const Sensor> scitos24_sensor() {
  std::array<double, scitos24_sonars> bearings_rad{};
  for (std::size_t i = 0; i < bearings_rad.size(); ++i)
    bearings_rad[i] = -15.0 * degree_rad * static_cast<double>(i);
  return make_ring("scitos24", bearings_rad, 0.28, 5.0);
}

std::shared_ptr<const Sensor> sensor_for(const LoadLogOptions& options,
                                         std::shared_ptr<const Sensor> implied) {
  const auto given = options.sensors.find(implied->name);
  if (given == options.sensors.end() || !given->second) return implied;
  if (given->second->beams.size() != implied->beams.size())
    throw Error(ErrorCode::invalid_argument, "sensor '" + implied->name +
                                                 "': " + std::to_string(given->second->beams.size()) +
                                                 " beams, expected " + std::to_string(implied->beams.size()));
  return given->second;
}

double read_finite(std::string_view word, const Place& place, std::string_view column) {
  const std::optional<double> value = parse_number(word);
  if (!value || !std::isfinite(*value))
    fail_format(place, column, word.empty() ? "the end of the line" : shown(word), "a finite number");
  return *value;
}

float read_range(std::string_view word, const Place& place, std::size_t sonar, double metres_per_unit) {
  const std::optional<double> value = parse_number(word);
  if (!value || !std::isfinite(*value) || *value < 0.0)
    fail_format(place, std::string("s") + std::to_string(sonar),
                word.empty() ? "the end of the line" : shown(word), "a range >= 0");
  return static_cast<float>(*value * metres_per_unit);
}

void expect_end(Words& words, const Place& place, std::size_t columns) {
  const std::string_view extra = words.next();
  if (!extra.empty())
    fail_format(place, "column " + std::to_string(columns + 1), shown(extra),
                std::to_string(columns) + " columns");
}

// Odometry by the time stamp's text, as both tables print it.
std::unordered_map<std::string, Pose2> read_corridor8_poses(const LogSource& source) {
  std::unordered_map<std::string, Pose2> T_odom_robot;
  Lines lines(source.text);
  for (std::string_view line; lines.next(line);) {
    const Place place{source.file, lines.number()};
    Words words(line);
    const std::string_view stamp = words.next();
    if (stamp.empty()) continue;
    read_finite(stamp, place, "t");
    const double x_mm = read_finite(words.next(), place, "x");
    const double y_mm = read_finite(words.next(), place, "y");
    const double theta_decidegrees = read_finite(words.next(), place, "theta");
    expect_end(words, place, 4);
    T_odom_robot[std::string(stamp)] = {.x_m = x_mm * 1e-3,
                                        .y_m = y_mm * 1e-3,
                                        .theta_rad = wrap_angle(theta_decidegrees * 0.1 * degree_rad)};
  }
  return T_odom_robot;
}

}  // namespace

Log read_corridor8(const LogSource& ranges, const LogSource& poses, const LoadLogOptions& options) {
  const auto T_odom_robot = read_corridor8_poses(poses);
  const auto sensor = sensor_for(options, corridor8_sensor());
  Log log;
  if (poses.text.empty()) log.warnings.push_back(ranges.file + ": no odometry: no poses table beside it");
  Lines lines(ranges.text);
  for (std::string_view line; lines.next(line);) {
    const Place place{ranges.file, lines.number()};
    Words words(line);
    const std::string_view stamp = words.next();
    if (stamp.empty()) continue;
    Scan scan;
    scan.sensor = sensor;
    scan.stamp_s = read_finite(stamp, place, "t") * 1e-3;
    for (std::size_t i = 0; i < corridor8_sonars; ++i)
      scan.ranges_m.push_back(read_range(words.next(), place, i, 1e-3));
    expect_end(words, place, corridor8_sonars + 1);
    const auto found = T_odom_robot.find(std::string(stamp));
    if (found != T_odom_robot.end()) scan.T_odom_robot = found->second;
    if (!poses.text.empty() && !scan.T_odom_robot)
      fail_format(place, "t", shown(stamp), "a time stamp of " + poses.file);
    log.scans.push_back(std::move(scan));
  }
  return log;
}

Log read_corridor8(const LogSource& source, const LoadLogOptions& options) {
  std::filesystem::path poses_path = source.file;
  std::string name = poses_path.filename().string();
  const std::size_t at = name.rfind("ranges");
  std::string poses_text;
  if (at != std::string::npos) {
    poses_path.replace_filename(name.replace(at, 6, "poses"));
    if (std::filesystem::exists(poses_path)) poses_text = read_text_file(poses_path);
  }
  return read_corridor8(source, {poses_text, poses_path.string()}, options);
}

Log read_scitos24(const LogSource& source, const LoadLogOptions& options) {
  const auto sensor = sensor_for(options, scitos24_sensor());
  Log log;
  Lines lines(source.text);
  for (std::string_view line; lines.next(line);) {
    if (line.empty()) continue;
    const Place place{source.file, lines.number()};
    Scan scan;
    scan.sensor = sensor;
    scan.stamp_s = static_cast<double>(log.scans.size());
    for (std::size_t i = 0; i < scitos24_sonars; ++i) {
      const std::size_t comma = line.find(',');
      scan.ranges_m.push_back(read_range(line.substr(0, comma), place, i, 1.0));
      line.remove_prefix(comma == std::string_view::npos ? line.size() : comma + 1);
    }
    if (line.empty() || line.find(',') != std::string_view::npos)
      fail_format(place, "column 25", shown(line), "the class label, as the last of 25 columns");
    log.scans.push_back(std::move(scan));
  }
  return log;
}

}  // namespace landfall::io
