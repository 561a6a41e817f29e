#include "engine/rank/cone_model.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include "engine/maps/to_raycast.hpp"

namespace landfall::internal {
namespace {

// Shares of all readings.
constexpr double too_long = 0.5;
constexpr double too_short = 0.03;
constexpr double anything = 0.03;
constexpr double right = 1.0 - too_long - too_short - anything;
// Where there is a wall in the cone: of sound that goes astray, half never comes back.
constexpr double no_echo_of_a_wall = 0.5 * too_long;
constexpr double most_independent = 20.0;

}  // namespace

ConeModel::ConeModel(const PreparedState& map, const Scan& readings)
    : map_(map),
      wall_depth_m_(map.is_plan() ? 0.0 : map.grid().resolution_m),
      range_noise_m_(readings.sensor->range_noise_m),
      range_noise_relative_(readings.sensor->range_noise_relative) {
  const std::vector<raycast::Beam> all = to_raycast(*readings.sensor);
  for (std::size_t b = 0; b < all.size(); ++b) {
    const landfall::Reading kind = classify(readings.sensor->beams[b], readings.ranges_m[b]);
    if (kind == landfall::Reading::invalid) continue;
    beams_.push_back(all[b]);
    readings_.push_back({.range_m = readings.ranges_m[b],
                         .range_max_m = all[b].range_max_m,
                         .echo = kind == landfall::Reading::echo});
  }
}

// Of an echo, per metre.
double ConeModel::likelihood(const Reading& reading, double nearest_m) const {
  const double wall_m = nearest_m + 0.5 * wall_depth_m_;
  if (wall_m >= reading.range_max_m)
    return reading.echo ? (too_short + anything) / reading.range_max_m : 1.0 - too_short - anything;
  if (!reading.echo) return no_echo_of_a_wall;
  const double noise_m = range_noise_m_ + range_noise_relative_ * wall_m;
  // Of a uniform distribution: its width squared over 12. A sensor that states no noise has a millimetre.
  const double variance = std::max(1e-6, noise_m * noise_m) + wall_depth_m_ * wall_depth_m_ / 12.0;
  const double off_m = reading.range_m - wall_m;
  const double at_wall =
      right * std::exp(-0.5 * off_m * off_m / variance) / std::sqrt(2.0 * std::numbers::pi * variance);
  // Over the whole range: else walls close to its end were the likelier for it.
  return at_wall + ((off_m > 0.0 ? too_long : too_short) + anything) / reading.range_max_m;
}

double ConeModel::log_likelihood(const Pose2& T_map_robot) const {
  std::vector<float> nearest_m(beams_.size());
  const raycast::Pose pose = to_raycast(T_map_robot);
  map_.scene().cast_fans(std::span(&pose, 1), beams_, nearest_m);
  double sum = 0.0;
  for (std::size_t i = 0; i < readings_.size(); ++i) sum += std::log(likelihood(readings_[i], nearest_m[i]));
  return sum *
         std::min(1.0, most_independent / static_cast<double>(std::max<std::size_t>(1, readings_.size())));
}

}  // namespace landfall::internal
