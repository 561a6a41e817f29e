// Triangulation-based fusion, scan by scan. Ivanjko, Petrovic & Miklic 2005, An Implementation of the
// Triangulation Based Fusion Mapping Algorithm, sections 3, 4 and 6. What was changed is said in tbf/.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "engine/mapping/located_sonars.hpp"
#include "engine/mapping/tbf/reading_window.hpp"
#include "engine/mapping/tbf/sonar_reading.hpp"
#include "engine/mapping/tbf/triangulation_grid.hpp"
#include "engine/mapping/tbf/wall_lines.hpp"
#include "landfall/sonar_mapping.hpp"

namespace landfall {
namespace {

constexpr const char* what = "tbf";
constexpr int most_window_scans = 1'000'000;

bool is_positive(double value) {
  return value > 0.0 && std::isfinite(value);
}

void check(const TbfOptions& options) {
  const auto require = [](bool holds, const char* field, double value, const char* expected) {
    internal::require_option(holds, what, field, value, expected);
  };
  require(options.window_scans >= 1 && options.window_scans <= most_window_scans, "window_scans",
          options.window_scans, "1 to a million");
  require(is_positive(options.max_deviation_m), "max_deviation_m", options.max_deviation_m,
          "a positive number");
  require(is_positive(options.scale_m2), "scale_m2", options.scale_m2, "a positive number");
  require(options.occupied_value > 0.0 && options.occupied_value <= 1.0, "occupied_value",
          options.occupied_value, "a number above 0 and at most 1");
  require(options.wall_gap_m >= 0.0 && std::isfinite(options.wall_gap_m), "wall_gap_m", options.wall_gap_m,
          "a number >= 0");
  require(is_positive(options.wall_length_m), "wall_length_m", options.wall_length_m, "a positive number");
}

std::vector<Scan> corrected(std::span<const Scan> scans, const TbfOptions& options) {
  std::vector<Scan> fused(scans.begin(), scans.end());
  if (options.bounding_box)
    for (Scan& scan : fused) scan = correct_to_bounding_box(scan, options.box_corrects_no_echo);
  return fused;
}

TriangulationPoint to_point(const internal::Triangulation& point, const internal::SonarReading& reading) {
  const internal::Symmetric2& covariance_m2 = point.covariance_m2();
  return {.p_map = point.p_map(),
          .covariance_xx_m2 = covariance_m2.xx,
          .covariance_xy_m2 = covariance_m2.xy,
          .covariance_yy_m2 = covariance_m2.yy,
          .triangulations = point.triangulations(),
          .scan = reading.scan,
          .beam = reading.beam};
}

// Of the sonars around the robot's centre.
double ring_radius_m(const Sensor& sensor) {
  double radius_m = 0.0;
  for (const Beam& beam : sensor.beams)
    radius_m = std::max(radius_m, std::hypot(beam.T_robot_beam.x_m, beam.T_robot_beam.y_m));
  return radius_m;
}

}  // namespace

TbfResult map_by_triangulation(std::span<const Scan> scans, const TbfOptions& options) {
  check(options);
  internal::validate_located_sonars(scans, what);
  TbfResult result;
  result.scans = corrected(scans, options);
  internal::TriangulationGrid grid(
      internal::grid_around(result.scans, options.resolution_m, options.margin_m, what), options);
  internal::ReadingWindow window(options.window_scans);
  for (std::size_t i = 0; i < result.scans.size(); ++i) {
    const Scan& scan = result.scans[i];
    const std::vector<internal::SonarReading> readings =
        internal::sonar_readings(scan, static_cast<std::uint32_t>(i));
    grid.add_robot(*scan.T_map_robot, ring_radius_m(*scan.sensor));
    for (const internal::SonarReading& reading : readings) {
      const std::optional<internal::Triangulation> point = window.triangulate(reading);
      if (!point) continue;  // an outlier
      grid.add(*point, reading);
      result.points.push_back(to_point(*point, reading));
    }
    window.push(readings);
  }
  result.map = grid.to_map();
  result.values = grid.values();
  if (options.connect_walls) internal::connect_walls(result.map, grid.on_line(), options);
  return result;
}

}  // namespace landfall
