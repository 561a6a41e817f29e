// Plain inverse sensor models of sonars. Elfes 1988, Using Occupancy Grids for Mobile Robot Perception and
// Navigation; its profiles as in Moravec & Elfes 1985, High Resolution Maps from Wide Angle Sonar. Changed:
// log odds are added where the first paper updates probabilities by Bayes' rule, which is the same, and
// bounded; the arc is three sigma of the sensor's own noise to either side, but at least a cell; one cell
// of the arc stopped the sound, so that a long arc says less of each (as 1985: there the sum is normalised).
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "engine/mapping/located_sonars.hpp"
#include "engine/mapping/log_odds_grid.hpp"
#include "engine/mapping/sector_cells.hpp"
#include "engine/mapping/tbf/sonar_reading.hpp"
#include "landfall/sonar_mapping.hpp"

namespace landfall {
namespace {

constexpr const char* what = "sonar grid";
constexpr double arc_sigmas = 3.0;

void check(const SonarGridOptions& options) {
  const auto require = [](bool holds, const char* field, double value, const char* expected) {
    internal::require_option(holds, what, field, value, expected);
  };
  require(options.occupied_weight > 0.0 && options.occupied_weight < 0.5, "occupied_weight",
          options.occupied_weight, "a number above 0 and below 0.5");
  require(options.empty_weight >= 0.0 && options.empty_weight < 0.5, "empty_weight", options.empty_weight,
          "a number >= 0 and below 0.5");
  require(options.free_log_odds < options.occupied_log_odds, "free_log_odds", options.free_log_odds,
          "less than occupied_log_odds");
  require(options.max_log_odds > 0.0, "max_log_odds", options.max_log_odds, "a positive number");
}

double log_odds(double probability) {
  return std::log(probability / (1.0 - probability));
}

// What an echo says of a cell of its cone, as a probability of being occupied.
double probability(const internal::SonarReading& reading, double half_arc_m, double distance_m,
                   double cos_off, const SonarGridOptions& options) {
  const double off = std::acos(std::min(1.0, cos_off)) / reading.arc.half_angle_rad;
  const double by_bearing = std::max(0.0, 1.0 - off * off);
  const double beyond_m = distance_m - reading.arc.radius_m;
  if (beyond_m >= -half_arc_m) {
    const double share = beyond_m / half_arc_m;
    const double arc_cells = 2.0 * reading.arc.half_angle_rad * reading.arc.radius_m / options.resolution_m;
    return 0.5 + options.occupied_weight / std::max(1.0, arc_cells) * by_bearing *
                     std::max(0.0, 1.0 - share * share);
  }
  const double share = distance_m / (reading.arc.radius_m - half_arc_m);
  return 0.5 - options.empty_weight * by_bearing * (1.0 - share * share);
}

}  // namespace

GridMap map_from_sonars(std::span<const Scan> scans, const SonarGridOptions& options) {
  check(options);
  internal::validate_located_sonars(scans, what);
  GridMap map = internal::grid_around(scans, options.resolution_m, options.margin_m, what);
  std::vector<float> sums(map.cells.size(), 0.0f);
  const auto most = static_cast<float>(options.max_log_odds);
  for (const Scan& scan : scans)
    for (const internal::SonarReading& reading : internal::sonar_readings(scan, 0)) {
      const double half_arc_m = std::max(map.resolution_m, arc_sigmas * reading.range_sigma_m);
      internal::visit_sector(map, reading.arc, reading.arc.radius_m + half_arc_m, reading.arc.cos_half_angle,
                             [&](std::size_t index, double distance_m, double cos_off) {
                               const double told =
                                   probability(reading, half_arc_m, distance_m, cos_off, options);
                               const float sum = sums[index] + static_cast<float>(log_odds(told));
                               sums[index] = std::clamp(sum, -most, most);
                             });
    }
  for (std::size_t i = 0; i < sums.size(); ++i)
    map.cells[i] = static_cast<double>(sums[i]) >= options.occupied_log_odds ? Occupancy::occupied
                   : static_cast<double>(sums[i]) <= options.free_log_odds   ? Occupancy::free
                                                                             : Occupancy::unknown;
  return map;
}

GridMap map_of_end_points(std::span<const Scan> scans, double resolution_m, double margin_m) {
  const std::string name = "end points";
  internal::validate_located_sonars(scans, name);
  // One hit decides for good: no number of misses outweighs it.
  const MappingOptions every_hit{.resolution_m = resolution_m,
                                 .log_odds_hit = 1e6,
                                 .log_odds_miss = -1.0,
                                 .occupied_log_odds = 0.5,
                                 .free_log_odds = -0.5,
                                 .max_log_odds = 1e6};
  internal::LogOddsGrid grid(internal::grid_around(scans, resolution_m, margin_m, name), every_hit);
  for (const Scan& scan : scans) grid.add_scan(internal::beam_lines(scan, 0.0));
  return std::move(grid).to_map();
}

}  // namespace landfall
