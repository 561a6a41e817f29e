#include "landfall/match_scans.hpp"

#include <cmath>
#include <string>
#include <vector>

#include "engine/base/number_text.hpp"
#include "engine/scan_matching/angle_histogram.hpp"
#include "engine/scan_matching/icp.hpp"
#include "landfall/error.hpp"

namespace landfall {
namespace {

void require(bool holds, const char* field, double value, const char* expected) {
  if (holds && std::isfinite(value)) return;
  throw Error(ErrorCode::invalid_argument,
              std::string("match_scans: ") + field + " is " + number_text(value) + ", expected " + expected);
}

void check(const ScanMatchOptions& options) {
  require(options.range_min_m >= 0.0, "range_min_m", options.range_min_m, "a number >= 0");
  require(options.reach_m > 0.0 && options.reach_m <= 100.0, "reach_m", options.reach_m,
          "more than 0, at most 100");
  require(options.reach_rad >= 0.0 && options.reach_rad <= std::numbers::pi, "reach_rad", options.reach_rad,
          "0 to pi");
  require(options.iterations >= 1 && options.iterations <= 10'000, "iterations", options.iterations,
          "1 to 10000");
  require(options.bin_m >= 0.001 && options.bin_m <= 1.0, "bin_m", options.bin_m, "0.001 to 1");
  require(options.bin_rad >= 0.0001 && options.bin_rad <= 1.0, "bin_rad", options.bin_rad, "0.0001 to 1");
}

std::vector<Point2> end_points(const Scan& scan, double range_min_m) {
  std::vector<Point2> points;
  for (std::size_t b = 0; b < scan.ranges_m.size(); ++b) {
    const Beam& beam = scan.sensor->beams[b];
    const double range_m = scan.ranges_m[b];
    if (classify(beam, scan.ranges_m[b]) != Reading::echo || range_m < range_min_m) continue;
    points.push_back(beam.T_robot_beam * Point2{.x_m = range_m, .y_m = 0.0});
  }
  return points;
}

}  // namespace

Pose2 match_scans(const Scan& before, const Scan& after, const Pose2& T_before_start,
                  const ScanMatchOptions& options) {
  check(options);
  if (!is_finite(T_before_start))
    throw Error(ErrorCode::invalid_argument, "match_scans: T_before_start is not finite");
  validate(before);
  validate(after);
  const std::vector<Point2> moving = end_points(after, options.range_min_m);
  std::vector<Point2> fixed = end_points(before, options.range_min_m);
  if (options.matcher == ScanMatcher::angle_histogram)
    return internal::match_histograms(fixed, moving, T_before_start,
                                      {.reach_m = options.reach_m,
                                       .reach_rad = options.reach_rad,
                                       .bin_m = options.bin_m,
                                       .bin_rad = options.bin_rad});
  const bool to_line = options.matcher == ScanMatcher::icp_point_to_line;
  return internal::IcpTarget(std::move(fixed), to_line)
      .match(moving, T_before_start,
             {.to_line = to_line, .iterations = options.iterations, .reach_m = options.reach_m});
}

}  // namespace landfall
