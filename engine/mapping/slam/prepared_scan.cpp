#include "engine/mapping/slam/prepared_scan.hpp"

#include <algorithm>
#include <cmath>

namespace landfall::internal {
namespace {

// Echoes are rarely off by more.
constexpr double noise_sigmas = 3.0;

}  // namespace

PreparedScan prepare(const Scan& scan, const SlamOptions& options) {
  PreparedScan prepared;
  std::vector<Echo> echoes;
  std::size_t last = 0;
  for (std::size_t b = 0; b < scan.ranges_m.size(); ++b) {
    const Beam& beam = scan.sensor->beams[b];
    const double range_m = scan.ranges_m[b];
    if (classify(beam, scan.ranges_m[b]) != Reading::echo || range_m < options.range_min_m) continue;
    if (options.range_max_m > 0.0 && range_m > options.range_max_m) continue;
    const Point2 p_origin{.x_m = beam.T_robot_beam.x_m, .y_m = beam.T_robot_beam.y_m};
    const Point2 p_end = beam.T_robot_beam * Point2{.x_m = range_m, .y_m = 0.0};
    const double sigma_m = scan.sensor->range_noise_m + scan.sensor->range_noise_relative * range_m;
    prepared.rays.push_back({.from_map = p_origin,
                             .to_map = p_end,
                             .noise_m = std::max(options.resolution_m, noise_sigmas * sigma_m),
                             .follows = !echoes.empty() && b == last + 1});
    echoes.push_back(
        {.p_origin = p_origin, .p_end = p_end, .range_m = range_m, .ray = beam.half_angle_rad == 0.0});
    last = b;
    prepared.x_cells.push_back(static_cast<float>(p_end.x_m / options.resolution_m));
    prepared.y_cells.push_back(static_cast<float>(p_end.y_m / options.resolution_m));
    prepared.farthest_m = std::max(prepared.farthest_m, std::hypot(p_end.x_m, p_end.y_m));
  }
  prepared.surfaces = surface_points(echoes);
  return prepared;
}

}  // namespace landfall::internal
