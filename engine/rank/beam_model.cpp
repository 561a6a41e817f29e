#include "engine/rank/beam_model.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <numbers>

#include "engine/maps/to_raycast.hpp"

namespace landfall::internal {
namespace {

constexpr double most_independent = 20.0;
constexpr double least_product = 1e-200;

}  // namespace

// Shares of all readings; what map and poses are off by.
struct BeamModel::Quality {
  double log_prior;
  double too_short;
  double too_long;
  double anything;
  double no_echo_of_a_wall;
  double off_m;

  [[nodiscard]] double hit() const { return 1.0 - too_short - too_long - anything; }
};

// As stated, rough, poor.
const BeamModel::Quality BeamModel::qualities[3] = {
    {-0.1, 0.06, 0.06, 0.02, 0.1, 0.0}, {-3.0, 0.15, 0.2, 0.05, 0.3, 0.1}, {-4.0, 0.25, 0.3, 0.1, 0.5, 0.25}};

BeamModel::BeamModel(const GridMap& map, const Scan& scan)
    : map_(map),
      T_grid_map_(inverse(map.T_map_grid)),
      range_noise_m_(scan.sensor->range_noise_m),
      range_noise_relative_(scan.sensor->range_noise_relative) {
  const std::vector<raycast::Beam> all = to_raycast(*scan.sensor);
  double echoes = 0.0;
  double sum_m = 0.0;
  for (std::size_t b = 0; b < scan.ranges_m.size(); ++b) {
    const Beam& beam = scan.sensor->beams[b];
    const landfall::Reading kind = classify(beam, scan.ranges_m[b]);
    if (kind == landfall::Reading::invalid) continue;
    const bool echo = kind == landfall::Reading::echo;
    const double range_m = echo ? scan.ranges_m[b] : beam.range_max_m;
    const Pose2 T_robot_end = beam.T_robot_beam * Pose2{range_m, 0.0, 0.0};
    beams_.push_back(all[b]);
    readings_.push_back({.range_m = range_m,
                         .range_max_m = beam.range_max_m,
                         .echo = echo,
                         .end_robot = {.x_m = T_robot_end.x_m, .y_m = T_robot_end.y_m}});
    if (!echo) continue;
    echoes += 1.0;
    sum_m += range_m;
  }
  if (echoes > 0.0) spread_m_ = 2.0 * sum_m / echoes;
}

std::vector<bool> BeamModel::from_unknown(const Pose2& T_map_robot) const {
  const Pose2 T_grid_robot = T_grid_map_ * T_map_robot;
  const double c = std::cos(T_grid_robot.theta_rad) / map_.resolution_m;
  const double s = std::sin(T_grid_robot.theta_rad) / map_.resolution_m;
  const double x_cells = T_grid_robot.x_m / map_.resolution_m;
  const double y_cells = T_grid_robot.y_m / map_.resolution_m;
  std::vector<bool> answers;
  for (const Reading& reading : readings_) {
    const Point2& end = reading.end_robot;
    const double col = std::floor(x_cells + c * end.x_m - s * end.y_m);
    const double row = std::floor(y_cells + s * end.x_m + c * end.y_m);
    const bool within = col >= 0.0 && row >= 0.0 && col < map_.width_cells && row < map_.height_cells;
    answers.push_back(reading.echo &&
                      (!within || map_.at({.col = static_cast<int>(col), .row = static_cast<int>(row)}) ==
                                      Occupancy::unknown));
  }
  return answers;
}

double BeamModel::weight_of_each() const {
  return std::min(1.0, most_independent / static_cast<double>(std::max<std::size_t>(1, readings_.size())));
}

// Of an echo, per metre.
double BeamModel::likelihood(const Reading& reading, double simulated_m, const PoseSpacing& spacing,
                             const Quality& quality) const {
  const bool sees_wall = simulated_m < reading.range_max_m;
  if (!reading.echo)
    return sees_wall ? quality.no_echo_of_a_wall : 1.0 - quality.too_short - quality.anything;
  const double anywhere = quality.anything / reading.range_max_m;
  if (!sees_wall) return anywhere + quality.too_short / reading.range_max_m;
  const double turned_m = spacing.rotation_rad * simulated_m;
  const double noise_m = range_noise_m_ + range_noise_relative_ * simulated_m;
  // Of a uniform distribution: its width squared over 12.
  const double variance = noise_m * noise_m + quality.off_m * quality.off_m +
                          (spacing.translation_m * spacing.translation_m + turned_m * turned_m) / 12.0;
  const double off_m = reading.range_m - simulated_m;
  const double at_wall = quality.hit() * std::exp(-0.5 * off_m * off_m / variance) /
                         std::sqrt(2.0 * std::numbers::pi * variance);
  const double before = off_m < 0.0 ? quality.too_short / simulated_m : 0.0;
  const double behind = off_m > 0.0 ? quality.too_long / (reading.range_max_m - simulated_m) : 0.0;
  return at_wall + before + behind + anywhere;
}

double BeamModel::log_likelihood(const Pose2& T_map_robot, std::span<const float> simulated_m,
                                 const PoseSpacing& spacing) const {
  const std::vector<bool> unknown = from_unknown(T_map_robot);
  std::array<double, std::size(qualities)> logs{};
  for (std::size_t q = 0; q < logs.size(); ++q) {
    double sum = 0.0;
    double product = 1.0;  // logarithms are slow
    for (std::size_t i = 0; i < readings_.size(); ++i) {
      const double one = likelihood(readings_[i], simulated_m[i], spacing, qualities[q]);
      const bool nothing_before = simulated_m[i] > readings_[i].range_m;
      product *= unknown[i] && nothing_before ? std::max(one, 1.0 / spread_m_) : one;
      if (product > least_product && product < 1.0 / least_product) continue;
      sum += std::log(product);
      product = 1.0;
    }
    logs[q] = qualities[q].log_prior + weight_of_each() * (sum + std::log(product));
  }
  const double best = *std::max_element(logs.begin(), logs.end());
  double total = 0.0;
  for (const double log : logs) total += std::exp(log - best);
  return best + std::log(total);
}

double BeamModel::log_likelihood_elsewhere() const {
  const auto all = static_cast<double>(readings_.size());
  const auto echoes = static_cast<double>(
      std::count_if(readings_.begin(), readings_.end(), [](const Reading& reading) { return reading.echo; }));
  // As many without echo as there are, on the average.
  double sum = 0.0;
  if (echoes > 0.0) sum += echoes * std::log(echoes / all / spread_m_);
  if (echoes < all) sum += (all - echoes) * std::log((all - echoes) / all);
  return weight_of_each() * sum;
}

}  // namespace landfall::internal
