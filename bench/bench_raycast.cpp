// Rays per second by every way: fans of neighbouring beams, single rays and cones, on a made-up office and,
// where the data are, on real maps and a real plan. Every way is checked against an oracle before anything is
// timed; the one that the engine chooses has the counter `chosen`; cones have but one. One thread.
#include <benchmark/benchmark.h>

#include <functional>
#include <memory>
#include <numbers>
#include <string>
#include <string_view>
#include <vector>

#include "bench/context.hpp"
#include "bench/ray_places.hpp"
#include "bench/way_report.hpp"
#include "landfall/search.hpp"

namespace landfall {
namespace {

using bench::RayPlace;
using Run = std::function<void(benchmark::State&)>;

constexpr double pi = std::numbers::pi;

void report_rays(benchmark::State& state, std::size_t rays_per_iteration) {
  state.counters["rays/s"] =
      benchmark::Counter(static_cast<double>(state.iterations()) * static_cast<double>(rays_per_iteration),
                         benchmark::Counter::kIsRate);
}

template <typename Caster>
Run fans(const RayPlace& place, const Caster& caster, const std::vector<raycast::Beam>& beams) {
  return [&place, &caster, beams](benchmark::State& state) {
    std::vector<float> ranges_m(place.poses.size() * beams.size());
    for (auto _ : state) {
      caster.cast_fans(place.poses, beams, ranges_m);
      benchmark::DoNotOptimize(ranges_m.data());
      benchmark::ClobberMemory();
    }
    report_rays(state, ranges_m.size());
  };
}

template <typename Caster>
Run single_rays(const RayPlace& place, const Caster& caster) {
  return [&place, &caster](benchmark::State& state) {
    const std::vector<raycast::Ray> rays = bench::scattered_rays(place);
    std::vector<float> ranges_m(rays.size());
    for (auto _ : state) {
      caster.cast_rays(rays, ranges_m);
      benchmark::DoNotOptimize(ranges_m.data());
      benchmark::ClobberMemory();
    }
    report_rays(state, rays.size());
  };
}

Run walked_rays(const RayPlace& place) {
  return [&place](benchmark::State& state) {
    const std::vector<raycast::Ray> rays = bench::scattered_rays(place);
    for (auto _ : state)
      for (const raycast::Ray& ray : rays) benchmark::DoNotOptimize(bench::walk_cells(place.grid, ray));
    report_rays(state, rays.size());
  };
}

void add(const RayPlace& place, const std::string& pattern, std::string_view way, bool chosen,
         const Run& run) {
  const auto marked = [run, chosen](benchmark::State& state) {
    run(state);
    if (chosen) state.counters["chosen"] = 1.0;
  };
  const std::string name = place.name + "/" + pattern + "/" + std::string(way);
  benchmark::RegisterBenchmark(name.c_str(), marked)->Unit(benchmark::kMillisecond);
}

void add_fan(const RayPlace& place, const std::string& pattern, const std::vector<raycast::Beam>& beams) {
  const raycast::Way chosen = place.scene->way();
  add(place, pattern, "embree", chosen == raycast::Way::embree, fans(place, *place.embree, beams));
  if (place.distance_walk)
    add(place, pattern, "distance_walk", chosen == raycast::Way::distance_walk,
        fans(place, *place.distance_walk, beams));
}

void register_place(const RayPlace& place) {
  add_fan(place, "fan_quarter_degree", bench::fan(720, pi / 720.0, 0.0));
  add_fan(place, "fan_half_degree", bench::fan(360, pi / 360.0, 0.0));
  add_fan(place, "fan_one_degree", bench::fan(180, pi / 180.0, 0.0));
  add_fan(place, "ring_15_degrees", bench::fan(24, pi / 12.0, 0.0));
  const raycast::Way chosen = place.scene->way();
  add(place, "single_rays", "embree", chosen == raycast::Way::embree, single_rays(place, *place.embree));
  if (place.distance_walk) {
    add(place, "single_rays", "distance_walk", chosen == raycast::Way::distance_walk,
        single_rays(place, *place.distance_walk));
    add(place, "single_rays", "grid_walk", false, walked_rays(place));
  }
  add(place, "cones_12_degrees", name(raycast::Way::segment_tree), false,
      fans(place, *place.scene, bench::ring_of_cones()));
}

}  // namespace
}  // namespace landfall

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  landfall::bench::name_instruction_set_and_executor();
  const std::vector<landfall::bench::RayPlace> places = landfall::bench::ray_places();
  for (const landfall::bench::RayPlace& place : places) {
    if (!landfall::bench::agrees_with_oracle(place)) return 1;
    landfall::register_place(place);
  }
  const std::unique_ptr<benchmark::BenchmarkReporter> own(benchmark::CreateDefaultDisplayReporter());
  landfall::bench::WayReport report(*own);
  benchmark::RunSpecifiedBenchmarks(&report);
  report.print_choices();
  benchmark::Shutdown();
  return 0;
}
