#include <cmath>
#include <cstddef>
#include <string>
#include <utility>

#include "engine/base/number_text.hpp"
#include "engine/mapping/log_odds_grid.hpp"
#include "engine/maps/grid_extent.hpp"
#include "landfall/error.hpp"
#include "landfall/mapping.hpp"

namespace landfall {
namespace {

void check(const MappingOptions& options) {
  const auto require = [](bool holds, const char* field, double value, const char* expected) {
    if (!holds)
      throw Error(ErrorCode::invalid_argument,
                  std::string("mapping: ") + field + " is " + number_text(value) + ", expected " + expected);
  };
  require(options.log_odds_hit > 0.0 && std::isfinite(options.log_odds_hit), "log_odds_hit",
          options.log_odds_hit, "a positive number");
  require(options.log_odds_miss < 0.0 && std::isfinite(options.log_odds_miss), "log_odds_miss",
          options.log_odds_miss, "a negative number");
  require(options.free_log_odds < options.occupied_log_odds, "free_log_odds", options.free_log_odds,
          "less than occupied_log_odds");
  require(options.max_log_odds > 0.0, "max_log_odds", options.max_log_odds, "a positive number");
  require(options.range_max_m >= 0.0, "range_max_m", options.range_max_m, "a number >= 0");
}

void validate_scans(std::span<const Scan> scans) {
  if (scans.empty()) throw Error(ErrorCode::invalid_argument, "mapping: no scans, expected at least one");
  for (std::size_t i = 0; i < scans.size(); ++i) {
    validate(scans[i]);
    if (!scans[i].T_map_robot)
      throw Error(ErrorCode::invalid_argument, "mapping: scan " + std::to_string(i) +
                                                   " has no T_map_robot, expected a pose in every scan");
  }
}

internal::Extent extent_of(std::span<const Scan> scans, double range_max_m) {
  internal::Extent extent;
  for (const Scan& scan : scans) {
    extent.add({.x_m = scan.T_map_robot->x_m, .y_m = scan.T_map_robot->y_m});
    for (const internal::BeamLine& line : internal::beam_lines(scan, range_max_m)) {
      extent.add(line.from_map);
      extent.add(line.to_map);
    }
  }
  return extent;
}

}  // namespace

GridMap map_from_known_poses(std::span<const Scan> scans, const MappingOptions& options) {
  check(options);
  validate_scans(scans);
  GridMap cells =
      internal::make_grid(extent_of(scans, options.range_max_m), {.resolution_m = options.resolution_m,
                                                                  .margin_m = options.margin_m,
                                                                  .fill = Occupancy::unknown,
                                                                  .what = "mapping"});
  internal::LogOddsGrid grid(std::move(cells), options);
  for (const Scan& scan : scans) grid.add_scan(internal::beam_lines(scan, options.range_max_m));
  return std::move(grid).to_map();
}

}  // namespace landfall
