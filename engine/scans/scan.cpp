#include "landfall/scan.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <string>

#include "engine/base/number_text.hpp"
#include "landfall/error.hpp"

namespace landfall {
namespace {

[[noreturn]] void fail(const std::string& message) {
  throw Error(ErrorCode::invalid_argument, message);
}

void validate_pose(const std::optional<Pose2>& pose, const char* field) {
  if (!pose || is_finite(*pose)) return;
  fail(std::string("scan: ") + field + " is " + pose_text(*pose) + ", expected finite numbers");
}

void check_noise(const RelativePoseNoise& noise) {
  const auto check = [](const char* field, double value) {
    if (!(value >= 0.0) || !std::isfinite(value))
      fail(std::string("noise of relative poses: ") + field + " is " + number_text(value) +
           ", expected a number >= 0");
  };
  check("translation_m", noise.translation_m);
  check("rotation_rad", noise.rotation_rad);
}

void validate_parts(const ScanParts& parts, std::size_t beams) {
  const std::size_t sum = std::accumulate(parts.beams.begin(), parts.beams.end(), std::size_t{0});
  if (sum != beams)
    fail("scan: its parts have " + std::to_string(sum) + " beams, expected " + std::to_string(beams));
  if (parts.T_reference_robot.size() != parts.beams.size() || parts.reference >= parts.beams.size())
    fail("scan: " + std::to_string(parts.T_reference_robot.size()) + " poses and reference " +
         std::to_string(parts.reference) + " for " + std::to_string(parts.beams.size()) + " parts");
  for (const Pose2& pose : parts.T_reference_robot) validate_pose(pose, "parts.T_reference_robot");
  check_noise(parts.noise);
}

void validate_measured(const Scan& measured, bool beside_parts) {
  if (beside_parts || measured.parts) fail("scan: measured and parts, expected one of them");
  if (measured.measured) fail("scan: measured is a condensed scan, expected the readings");
  validate(measured);
}

int count_readings(const Scan& scan, bool echoes_alone) {
  int count = 0;
  const std::size_t beams = std::min(scan.ranges_m.size(), scan.sensor ? scan.sensor->beams.size() : 0);
  for (std::size_t b = 0; b < beams; ++b) {
    const Reading reading = classify(scan.sensor->beams[b], scan.ranges_m[b]);
    count += reading == Reading::echo || (!echoes_alone && reading == Reading::no_echo);
  }
  return count;
}

void check_mergeable(std::span<const Scan> scans, std::span<const Pose2> T_common_robot,
                     std::size_t reference) {
  if (scans.empty()) fail("merge: no scans, expected at least one");
  if (T_common_robot.size() != scans.size())
    fail("merge: " + std::to_string(T_common_robot.size()) + " poses for " + std::to_string(scans.size()) +
         " scans, expected one each");
  if (reference >= scans.size())
    fail("merge: reference is " + std::to_string(reference) + ", expected a scan below " +
         std::to_string(scans.size()));
  for (std::size_t i = 0; i < scans.size(); ++i) {
    validate(scans[i]);
    if (!is_finite(T_common_robot[i])) fail("merge: pose " + std::to_string(i) + " is not finite");
  }
}

}  // namespace

// Limits are compared as floats: a reading that a log prints as the sensor's maximum stays the maximum.
Reading classify(const Beam& beam, float range_m) {
  if (!(range_m > 0.0f) || range_m < static_cast<float>(beam.range_min_m)) return Reading::invalid;
  return range_m >= static_cast<float>(beam.range_max_m) ? Reading::no_echo : Reading::echo;
}

int count_valid(const Scan& scan) {
  return count_readings(scan, false);
}

int count_echoes(const Scan& scan) {
  return count_readings(scan, true);
}

void validate(const Scan& scan) {
  if (!scan.sensor) fail("scan: no sensor");
  validate(*scan.sensor);
  if (scan.ranges_m.size() != scan.sensor->beams.size())
    fail("scan: " + std::to_string(scan.ranges_m.size()) + " ranges, expected " +
         std::to_string(scan.sensor->beams.size()) + " as sensor '" + scan.sensor->name + "' has beams");
  if (!std::isfinite(scan.stamp_s))
    fail("scan: stamp_s is " + number_text(scan.stamp_s) + ", expected a finite number");
  validate_pose(scan.T_odom_robot, "T_odom_robot");
  validate_pose(scan.T_map_robot, "T_map_robot");
  if (scan.parts) validate_parts(*scan.parts, scan.ranges_m.size());
  if (scan.measured) validate_measured(*scan.measured, scan.parts.has_value());
}

Scan merge(std::span<const Scan> scans, std::span<const Pose2> T_common_robot, std::size_t reference,
           const RelativePoseNoise& noise) {
  check_mergeable(scans, T_common_robot, reference);
  check_noise(noise);
  ScanParts parts{.reference = reference, .noise = noise};
  Sensor sensor{.name = "composite", .beams = {}, .range_noise_m = 0.0, .range_noise_relative = 0.0};
  std::vector<float> ranges_m;
  const Pose2 T_reference_common = inverse(T_common_robot[reference]);
  for (std::size_t i = 0; i < scans.size(); ++i) {
    const Sensor& part = *scans[i].sensor;
    sensor.range_noise_m = std::max(sensor.range_noise_m, part.range_noise_m);
    sensor.range_noise_relative = std::max(sensor.range_noise_relative, part.range_noise_relative);
    const Pose2 T_reference_robot = i == reference ? Pose2{} : T_reference_common * T_common_robot[i];
    for (Beam beam : part.beams) {
      beam.T_robot_beam = T_reference_robot * beam.T_robot_beam;
      sensor.beams.push_back(beam);
    }
    parts.beams.push_back(part.beams.size());
    parts.T_reference_robot.push_back(T_reference_robot);
    ranges_m.insert(ranges_m.end(), scans[i].ranges_m.begin(), scans[i].ranges_m.end());
  }
  validate(sensor);
  const bool may_be_off = noise.translation_m > 0.0 || noise.rotation_rad > 0.0;
  return {.sensor = std::make_shared<const Sensor>(std::move(sensor)),
          .ranges_m = std::move(ranges_m),
          .stamp_s = scans[reference].stamp_s,
          .T_odom_robot = scans[reference].T_odom_robot,
          .T_map_robot = scans[reference].T_map_robot,
          .parts = may_be_off && scans.size() > 1 ? std::optional(std::move(parts)) : std::nullopt};
}

std::vector<Pose2> odometry_of(std::span<const Scan> scans) {
  std::vector<Pose2> T_odom_robot;
  T_odom_robot.reserve(scans.size());
  for (std::size_t i = 0; i < scans.size(); ++i) {
    if (!scans[i].T_odom_robot)
      fail("scan " + std::to_string(i) + " has no T_odom_robot, expected odometry in every scan");
    T_odom_robot.push_back(*scans[i].T_odom_robot);
  }
  return T_odom_robot;
}

Scan merge(std::span<const Scan> scans) {
  return merge(scans, odometry_of(scans), scans.size() - 1);
}

}  // namespace landfall
