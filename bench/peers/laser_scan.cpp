#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdio>
#include <memory>
#include <numbers>
#include <vector>

#include "bench/peers/comparisons.hpp"
#include "bench/peers/mrpt.hpp"
#include "engine/base/counter_rng.hpp"
#include "engine/maps/prepared_state.hpp"
#include "engine/maps/to_raycast.hpp"

namespace landfall::bench {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double range_max_m = 80.0;

// Fans of a degree a beam from random free poses.
struct Task {
  static constexpr std::size_t pose_count = 200;
  static constexpr std::size_t beam_count = 180;
  static constexpr double aperture_rad = (beam_count - 1) * pi / 180.0;

  PreparedMap map;
  std::vector<Pose2> T_grid_robot;
  std::vector<raycast::Pose> T_map_robot;
  std::vector<raycast::Beam> beams;

  explicit Task(const Place& place) : map(place.map) {
    const GridMap& grid = map.grid();
    internal::CounterRng rng(1);
    while (T_grid_robot.size() < pose_count) {
      const Pose2 pose{.x_m = rng.uniform() * grid.width_cells * grid.resolution_m,
                       .y_m = rng.uniform() * grid.height_cells * grid.resolution_m,
                       .theta_rad = 2.0 * pi * rng.uniform()};
      const Pose2 T_map_pose = grid.T_map_grid * pose;
      if (grid.at(grid.cell_of({T_map_pose.x_m, T_map_pose.y_m})) != Occupancy::free) continue;
      T_grid_robot.push_back(pose);
      T_map_robot.push_back(internal::to_raycast(T_map_pose));
    }
    for (std::size_t b = 0; b < beam_count; ++b)
      beams.push_back({.x_m = 0.0,
                       .y_m = 0.0,
                       .theta_rad = static_cast<double>(b) * pi / 180.0 - aperture_rad / 2.0,
                       .half_angle_rad = 0.0,
                       .range_max_m = range_max_m});
  }
};

void cast(const Task& task, const MrptMap& peer, std::vector<float>& ranges_m) {
  for (std::size_t i = 0; i < Task::pose_count; ++i)
    peer.simulate_scan(task.T_grid_robot[i], Task::aperture_rad, range_max_m,
                       std::span(ranges_m).subspan(i * Task::beam_count, Task::beam_count));
}

void cast(const Task& task, const raycast::Scene& scene, std::vector<float>& ranges_m) {
  scene.cast_fans(task.T_map_robot, task.beams, ranges_m);
}

// MRPT walks in steps of 0.8 cells: it may pass a corner, and a range is good to about a step and a cell.
bool ranges_agree(const Place& place, const Task& task, const MrptMap& peer, const raycast::Scene& scene) {
  constexpr double least_share = 0.9;
  const double tolerance_m = 1.5 * task.map.grid().resolution_m;
  std::vector<float> theirs(Task::pose_count * Task::beam_count);
  std::vector<float> ours(theirs.size());
  cast(task, peer, theirs);
  cast(task, scene, ours);
  std::size_t agree = 0;
  for (std::size_t i = 0; i < ours.size(); ++i) {
    const bool both_miss = std::isinf(theirs[i]) && std::isinf(ours[i]);
    agree += both_miss || std::abs(theirs[i] - ours[i]) < tolerance_m ? 1 : 0;
  }
  const double share = static_cast<double>(agree) / static_cast<double>(ours.size());
  if (share < least_share)
    std::fprintf(stderr, "%s: MRPT and landfall agree on %.1f %% of the ranges\n", place.name.c_str(),
                 100.0 * share);
  return share >= least_share;
}

template <class Caster>
void time_casting(benchmark::State& state, const Task& task, const Caster& caster) {
  std::vector<float> ranges_m(Task::pose_count * Task::beam_count);
  for (auto _ : state) {
    cast(task, caster, ranges_m);
    benchmark::DoNotOptimize(ranges_m.data());
  }
  state.counters["rays/s"] =
      benchmark::Counter(static_cast<double>(ranges_m.size()), benchmark::Counter::kIsIterationInvariantRate);
}

}  // namespace

bool compare_laser_scan(const Place& place) {
  const auto task = std::make_shared<const Task>(place);
  const auto peer = std::make_shared<const MrptMap>(place.map);
  if (!ranges_agree(place, *task, *peer, place.map.state().scene())) return false;
  const auto add = [&](const char* who, const auto& run) {
    benchmark::RegisterBenchmark((place.name + "/laser_scan/" + who).c_str(), run)
        ->Unit(benchmark::kMillisecond);
  };
  add("mrpt", [task, peer](benchmark::State& state) { time_casting(state, *task, *peer); });
  add("landfall", [task](benchmark::State& state) { time_casting(state, *task, task->map.state().scene()); });
  return true;
}

}  // namespace landfall::bench
