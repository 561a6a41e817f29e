#include "landfall/simulate.hpp"

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "engine/counter_rng.hpp"
#include "engine/prepared_state.hpp"
#include "engine/to_raycast.hpp"
#include "landfall/error.hpp"

namespace landfall {
namespace {

constexpr std::size_t poses_per_task = 16;

void validate_poses(std::span<const Pose2> T_map_robot) {
  for (std::size_t i = 0; i < T_map_robot.size(); ++i)
    if (!is_finite(T_map_robot[i]))
      throw Error(ErrorCode::invalid_argument, "simulate: pose " + std::to_string(i) + " is not finite");
}

float with_noise(float range_m, const Sensor& sensor, internal::CounterRng rng) {
  const double sigma_m = sensor.range_noise_m + sensor.range_noise_relative * range_m;
  return static_cast<float>(std::max(0.0, range_m + sigma_m * rng.normal()));
}

}  // namespace

std::vector<float> simulate_ranges(const PreparedMap& map, const Sensor& sensor,
                                   std::span<const Pose2> T_map_robot) {
  validate(sensor);
  validate_poses(T_map_robot);
  const raycast::Scene& scene = map.state().scene();
  const std::vector<raycast::Beam> beams = internal::to_raycast(sensor);
  std::vector<raycast::Pose> poses;
  for (const Pose2& pose : T_map_robot) poses.push_back(internal::to_raycast(pose));
  std::vector<float> ranges_m(poses.size() * beams.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, poses.size(), poses_per_task), [&](const auto& part) {
    scene.cast_fans(std::span(poses).subspan(part.begin(), part.size()), beams,
                    std::span(ranges_m).subspan(part.begin() * beams.size(), part.size() * beams.size()));
  });
  return ranges_m;
}

std::vector<Scan> simulate(const PreparedMap& map, std::shared_ptr<const Sensor> sensor,
                           std::span<const Pose2> T_map_robot, const SimulateOptions& options) {
  if (!sensor) throw Error(ErrorCode::invalid_argument, "simulate: no sensor");
  const std::vector<float> ranges_m = simulate_ranges(map, *sensor, T_map_robot);
  const std::size_t beams = sensor->beams.size();
  std::vector<Scan> scans(T_map_robot.size());
  tbb::parallel_for(std::size_t{0}, scans.size(), [&](std::size_t i) {
    scans[i].sensor = sensor;
    scans[i].T_map_robot = T_map_robot[i];
    scans[i].ranges_m.resize(beams);
    for (std::size_t b = 0; b < beams; ++b) {
      float range_m = ranges_m[i * beams + b];
      const auto range_max_m = static_cast<float>(sensor->beams[b].range_max_m);
      if (options.noise && range_m < range_max_m)
        range_m = with_noise(
            range_m, *sensor,
            internal::CounterRng(options.seed, static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(b)));
      scans[i].ranges_m[b] = std::min(range_m, range_max_m);
    }
  });
  return scans;
}

}  // namespace landfall
