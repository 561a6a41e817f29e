#include "landfall/simulate.hpp"

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>

#include "engine/base/counter_rng.hpp"
#include "engine/base/parallel.hpp"
#include "engine/maps/prepared_state.hpp"
#include "engine/maps/to_raycast.hpp"
#include "landfall/error.hpp"

namespace landfall {
namespace {

constexpr std::size_t poses_per_task = 16;
constexpr int all_threads = 0;

void validate_poses(std::span<const Pose2> T_map_robot) {
  for (std::size_t i = 0; i < T_map_robot.size(); ++i)
    if (!is_finite(T_map_robot[i]))
      throw Error(ErrorCode::invalid_argument, "simulate: pose " + std::to_string(i) + " is not finite");
}

// What the sensor reports where a beam would measure range_m without noise.
float reading(const Sensor& sensor, std::size_t beam, float range_m, const SimulateOptions& options,
              std::size_t pose) {
  const auto range_max_m = static_cast<float>(sensor.beams[beam].range_max_m);
  if (!(range_m < range_max_m)) return range_max_m;
  if (!options.noise) return range_m;
  internal::CounterRng rng(options.seed, static_cast<std::uint32_t>(pose), static_cast<std::uint32_t>(beam));
  const double sigma_m = sensor.range_noise_m + sensor.range_noise_relative * range_m;
  return std::min(range_max_m, static_cast<float>(std::max(0.0, range_m + sigma_m * rng.normal())));
}

}  // namespace

std::vector<float> simulate_ranges(const PreparedMap& map, const Sensor& sensor,
                                   std::span<const Pose2> T_map_robot) {
  validate(sensor);
  validate_poses(T_map_robot);
  const raycast::Scene& scene = map.state().scene();
  const std::vector<raycast::Beam> beams = internal::to_raycast(sensor);
  std::vector<raycast::Pose> poses;
  poses.reserve(T_map_robot.size());
  for (const Pose2& pose : T_map_robot) poses.push_back(internal::to_raycast(pose));
  std::vector<float> ranges_m(poses.size() * beams.size());
  const std::size_t tasks = (poses.size() + poses_per_task - 1) / poses_per_task;
  internal::parallel_for(tasks, all_threads, [&](std::size_t task) {
    const std::size_t first = task * poses_per_task;
    const std::size_t count = std::min(poses_per_task, poses.size() - first);
    scene.cast_fans(std::span(poses).subspan(first, count), beams,
                    std::span(ranges_m).subspan(first * beams.size(), count * beams.size()));
  });
  return ranges_m;
}

std::string ray_caster(const PreparedMap& map, const Sensor& sensor) {
  validate(sensor);
  const raycast::Scene& scene = map.state().scene();
  const auto is_cone = [](const Beam& beam) { return beam.half_angle_rad > 0.0; };
  const bool cones = std::any_of(sensor.beams.begin(), sensor.beams.end(), is_cone);
  const bool rays = !std::all_of(sensor.beams.begin(), sensor.beams.end(), is_cone);
  std::string names(rays ? name(scene.way()) : "");
  if (rays && cones) names += ", ";
  if (cones) names += name(raycast::Way::segment_tree);
  return names;
}

std::vector<Scan> simulate(const PreparedMap& map, std::shared_ptr<const Sensor> sensor,
                           std::span<const Pose2> T_map_robot, const SimulateOptions& options) {
  if (!sensor) throw Error(ErrorCode::invalid_argument, "simulate: no sensor");
  const std::vector<float> ranges_m = simulate_ranges(map, *sensor, T_map_robot);
  const std::size_t beams = sensor->beams.size();
  std::vector<Scan> scans(T_map_robot.size());
  internal::parallel_for(scans.size(), all_threads, [&](std::size_t i) {
    scans[i].sensor = sensor;
    scans[i].T_map_robot = T_map_robot[i];
    scans[i].ranges_m.resize(beams);
    for (std::size_t b = 0; b < beams; ++b)
      scans[i].ranges_m[b] = reading(*sensor, b, ranges_m[i * beams + b], options, i);
  });
  return scans;
}

}  // namespace landfall
