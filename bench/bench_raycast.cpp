// Rays per second: fans of neighbouring beams, single rays and cones, on a real map and a real plan (where
// the data are) and on a made-up office; the exact grid walk beside them on grids. Every place is checked
// against its oracle before anything is timed. One thread.
#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdio>
#include <functional>
#include <memory>
#include <numbers>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "bench/office.hpp"
#include "engine/to_raycast.hpp"
#include "landfall/io.hpp"
#include "tests/data_folder.hpp"
#include "tests/raycast/agreement.hpp"
#include "tests/raycast/grid_oracle.hpp"
#include "tests/raycast/wall_oracle.hpp"

namespace landfall {
namespace {

constexpr double range_max_m = 80.0;
constexpr double pi = std::numbers::pi;
constexpr int pose_count = 500;

struct Place {
  std::string name;
  GridMap grid;
  bool has_own_walls;  // a plan: the grid only says where it is free
  std::vector<raycast::Segment> walls;
  std::shared_ptr<const raycast::Scene> scene;
  std::vector<raycast::Pose> poses;  // random, on free cells
};

Place make_place(std::string name, GridMap grid, const std::optional<WallMap>& plan) {
  std::vector<raycast::Segment> walls = internal::to_raycast(plan ? *plan : to_walls(grid));
  auto scene = std::make_shared<const raycast::Scene>(walls);
  std::mt19937 rng(1);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  std::vector<raycast::Pose> poses;
  while (poses.size() < pose_count) {
    const Pose2 pose = grid.T_map_grid * Pose2{.x_m = uniform(rng) * grid.width_cells * grid.resolution_m,
                                               .y_m = uniform(rng) * grid.height_cells * grid.resolution_m,
                                               .theta_rad = uniform(rng) * 2.0 * pi};
    if (grid.at(grid.cell_of({.x_m = pose.x_m, .y_m = pose.y_m})) == Occupancy::free)
      poses.push_back(internal::to_raycast(pose));
  }
  return {std::move(name),  std::move(grid),  plan.has_value(),
          std::move(walls), std::move(scene), std::move(poses)};
}

std::vector<raycast::Beam> fan(int count, double step_rad, double half_angle_rad) {
  std::vector<raycast::Beam> beams;
  beams.reserve(static_cast<std::size_t>(count));
  for (int b = 0; b < count; ++b)
    beams.push_back({.x_m = 0.0,
                     .y_m = 0.0,
                     .theta_rad = b * step_rad,
                     .half_angle_rad = half_angle_rad,
                     .range_max_m = range_max_m});
  return beams;
}

// As many rays as a fan of 180 has per pose, in an order that has nothing in common.
std::vector<raycast::Ray> scattered_rays(const Place& place) {
  std::mt19937 rng(2);
  std::uniform_real_distribution<double> angle_rad(-pi, pi);
  std::uniform_int_distribution<std::size_t> pose(0, place.poses.size() - 1);
  std::vector<raycast::Ray> rays;
  for (int i = 0; i < 180 * pose_count; ++i) {
    const raycast::Pose& from = place.poses[pose(rng)];
    const double theta_rad = angle_rad(rng);
    rays.push_back({.x_m = from.x_m,
                    .y_m = from.y_m,
                    .dx = static_cast<float>(std::cos(theta_rad)),
                    .dy = static_cast<float>(std::sin(theta_rad)),
                    .range_max_m = static_cast<float>(range_max_m)});
  }
  return rays;
}

bool agrees_with_oracle(const Place& place) {
  const std::vector<raycast::Beam> beams = fan(180, pi / 180.0, 0.0);
  std::vector<float> ranges_m(beams.size());
  testing::Agreement agreement;
  for (std::size_t p = 0; p < place.poses.size(); p += 10) {
    const raycast::Pose& pose = place.poses[p];
    place.scene->cast_fans({&pose, 1}, beams, ranges_m);
    for (std::size_t b = 0; b < beams.size(); ++b)
      agreement.add(ranges_m[b], range_max_m, [&](double shift_m) {
        const double theta_rad = pose.theta_rad + beams[b].theta_rad;
        return place.has_own_walls ? testing::crossed_range_m(place.walls, {pose.x_m, pose.y_m, theta_rad},
                                                              range_max_m, shift_m)
                                   : testing::walked_range_m(place.grid, {pose.x_m, pose.y_m, theta_rad},
                                                             range_max_m, shift_m);
      });
  }
  if (!agreement.holds())
    std::fprintf(stderr, "%s: %d of %d rays differ from the oracle, %d graze\n", place.name.c_str(),
                 agreement.wrong, agreement.rays, agreement.grazing);
  return agreement.holds();
}

void report_rays(benchmark::State& state, std::size_t rays_per_iteration) {
  state.counters["rays/s"] =
      benchmark::Counter(static_cast<double>(state.iterations()) * static_cast<double>(rays_per_iteration),
                         benchmark::Counter::kIsRate);
}

void cast_fans(benchmark::State& state, const Place& place, const std::vector<raycast::Beam>& beams) {
  std::vector<float> ranges_m(place.poses.size() * beams.size());
  for (auto _ : state) {
    place.scene->cast_fans(place.poses, beams, ranges_m);
    benchmark::DoNotOptimize(ranges_m.data());
  }
  report_rays(state, ranges_m.size());
}

void cast_rays(benchmark::State& state, const Place& place) {
  const std::vector<raycast::Ray> rays = scattered_rays(place);
  std::vector<float> ranges_m(rays.size());
  for (auto _ : state) {
    place.scene->cast_rays(rays, ranges_m);
    benchmark::DoNotOptimize(ranges_m.data());
  }
  report_rays(state, rays.size());
}

void walk_rays(benchmark::State& state, const Place& place) {
  const std::vector<raycast::Ray> rays = scattered_rays(place);
  const raycast::Grid grid = testing::grid_view(place.grid);
  const double cells_per_m = 1.0 / place.grid.resolution_m;
  const Point2 corner{.x_m = place.grid.T_map_grid.x_m, .y_m = place.grid.T_map_grid.y_m};
  for (auto _ : state)
    for (const raycast::Ray& ray : rays)
      benchmark::DoNotOptimize(raycast::walk_grid(grid, (ray.x_m - corner.x_m) * cells_per_m,
                                                  (ray.y_m - corner.y_m) * cells_per_m, ray.dx, ray.dy,
                                                  range_max_m * cells_per_m));
  report_rays(state, rays.size());
}

void register_place(const Place& place) {
  const auto add = [&](const char* what, const std::function<void(benchmark::State&)>& run) {
    benchmark::RegisterBenchmark((place.name + "/" + what).c_str(), run)->Unit(benchmark::kMillisecond);
  };
  const auto add_fan = [&](const char* what, const std::vector<raycast::Beam>& beams) {
    add(what, [&place, beams](benchmark::State& state) { cast_fans(state, place, beams); });
  };
  add_fan("fan_quarter_degree", fan(720, pi / 720.0, 0.0));
  add_fan("fan_half_degree", fan(360, pi / 360.0, 0.0));
  add_fan("fan_one_degree", fan(180, pi / 180.0, 0.0));
  add_fan("ring_15_degrees", fan(24, pi / 12.0, 0.0));
  add_fan("cones_12_degrees", fan(24, pi / 12.0, pi / 30.0));
  add("single_rays", [&place](benchmark::State& state) { cast_rays(state, place); });
  if (!place.has_own_walls)
    add("single_rays_grid_walk", [&place](benchmark::State& state) { walk_rays(state, place); });
}

std::vector<Place> places() {
  std::vector<Place> all;
  all.push_back(make_place("office", bench::office(), std::nullopt));
  if (!testing::has_data()) {
    std::fprintf(stderr, "no real data: set LANDFALL_DATA\n");
    return all;
  }
  for (const char* name : {"intel", "infinite_corridor"})
    all.push_back(make_place(name, load_grid_map(testing::data_folder() / name / "map.yaml"), std::nullopt));
  const WallMap mall = load_wall_map(testing::data_folder() / "plans" / "mall_site1_F1.json");
  all.push_back(make_place("mall_plan", to_grid(mall, {.resolution_m = 0.1, .outside_unknown = true}), mall));
  return all;
}

}  // namespace
}  // namespace landfall

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  const std::vector<landfall::Place> places = landfall::places();
  for (const landfall::Place& place : places) {
    if (!landfall::agrees_with_oracle(place)) return 1;
    landfall::register_place(place);
  }
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}
