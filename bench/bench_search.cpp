// The search as users meet it: latency of a scan, scans a second, preparation, and the exhaustive oracle.
// On a made-up office, and where the data are on a sample of each building's queries, no prior. Branch and
// bound is held to exhaustive search on a coarse lattice of each place before anything is timed.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "bench/office.hpp"
#include "engine/counter_rng.hpp"
#include "landfall/io.hpp"
#include "landfall/search.hpp"
#include "landfall/simulate.hpp"
#include "tests/data_folder.hpp"

namespace landfall::bench {
namespace {

constexpr std::size_t scans_per_place = 24;
constexpr double coarse_rotation_step_rad = std::numbers::pi / 12.0;  // 15 degrees
constexpr std::size_t most_cells_exhaustive = 1'000'000;              // on larger maps it takes seconds
const PosePrior anywhere{Anywhere{}};

struct Place {
  std::string name;
  PreparedMap map;
  std::vector<Scan> scans;
};

// Scans of 180 beams from random free poses.
Place office_place() {
  const PreparedMap map(office());
  internal::CounterRng rng(1);
  std::vector<Pose2> T_map_robot;
  while (T_map_robot.size() < scans_per_place) {
    const Pose2 pose{.x_m = 30.0 * rng.uniform(),
                     .y_m = 30.0 * rng.uniform(),
                     .theta_rad = 2.0 * std::numbers::pi * rng.uniform()};
    if (map.grid().at(map.grid().cell_of({pose.x_m, pose.y_m})) == Occupancy::free)
      T_map_robot.push_back(pose);
  }
  const auto sensor = std::make_shared<const Sensor>(
      make_fan({.beams = 180, .first_rad = -std::numbers::pi / 2.0, .step_rad = std::numbers::pi / 180.0}));
  return {"office", map, simulate(map, sensor, T_map_robot)};
}

// Queries evenly spread over the log.
Place building_place(const std::string& name) {
  const std::filesystem::path folder = testing::data_folder() / name;
  const std::vector<Scan> log = load_log(folder / "query.log.gz").scans;
  Place place{name, load_map(folder / "map.yaml"), {}};
  for (std::size_t i = 0; i < scans_per_place; ++i)
    place.scans.push_back(log[i * (log.size() - 1) / (scans_per_place - 1)]);
  return place;
}

bool equals_exhaustive(const Place& place) {
  for (const std::size_t i : {std::size_t{0}, scans_per_place / 2}) {
    SearchOptions options{.rotation_step_rad = coarse_rotation_step_rad, .max_hypotheses = 8};
    options.method = "exhaustive";
    const SearchResult expected = search(place.map, anywhere, place.scans[i], options);
    options.method = "branch_and_bound";
    const SearchResult result = search(place.map, anywhere, place.scans[i], options);
    const auto best_score = [](const SearchResult& of) {
      std::int64_t best = 0;
      for (const Hypothesis& hypothesis : of.hypotheses) best = std::max(best, hypothesis.score);
      return best;
    };
    if (best_score(result) == best_score(expected) && result.proven) continue;
    std::fprintf(stderr, "%s, scan %zu: branch and bound scores %lld, exhaustive %lld\n", place.name.c_str(),
                 i, static_cast<long long>(best_score(result)), static_cast<long long>(best_score(expected)));
    return false;
  }
  return true;
}

double quantile(std::vector<double>& values, double share) {
  const auto at =
      values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

// One scan after the other, each with all threads: an iteration is all of the place's scans.
void time_latency(benchmark::State& state, const Place& place, int threads) {
  const SearchOptions options{.method = "branch_and_bound", .threads = threads};
  std::vector<double> search_ms;
  for (auto _ : state)
    for (const Scan& scan : place.scans) {
      const SearchResult result = search(place.map, anywhere, scan, options);
      search_ms.push_back(result.times.total_ms);
      state.SetLabel(result.method);
    }
  state.counters["median_ms"] = quantile(search_ms, 0.5);
  state.counters["p95_ms"] = quantile(search_ms, 0.95);
  state.counters["max_ms"] = quantile(search_ms, 1.0);
}

// All scans in one call, side by side.
void time_batch(benchmark::State& state, const Place& place, int threads) {
  const SearchOptions options{.method = "branch_and_bound", .threads = threads};
  for (auto _ : state) benchmark::DoNotOptimize(search(place.map, anywhere, place.scans, options));
  state.counters["scans/s"] =
      benchmark::Counter(static_cast<double>(state.iterations()) * static_cast<double>(place.scans.size()),
                         benchmark::Counter::kIsRate);
}

// Free poses of a lattice that is coarse in heading.
void time_exhaustive(benchmark::State& state, const Place& place, int threads) {
  const SearchOptions options{
      .method = "exhaustive", .rotation_step_rad = coarse_rotation_step_rad, .threads = threads};
  double poses = 0.0;
  for (auto _ : state)
    poses +=
        static_cast<double>(search(place.map, anywhere, place.scans.front(), options).counts.poses_covered);
  state.counters["poses/s"] = benchmark::Counter(poses, benchmark::Counter::kIsRate);
}

void time_prepare(benchmark::State& state, const Place& place) {
  double bytes = 0.0;
  for (auto _ : state) {
    const PreparedMap fresh(place.map.grid(), place.map.options());
    fresh.prepare();
    bytes = static_cast<double>(fresh.memory_bytes());
  }
  const auto cells = static_cast<double>(place.map.grid().cells.size());
  state.counters["bytes/cell"] = bytes / cells;
  state.counters["cells/s"] = benchmark::Counter(cells, benchmark::Counter::kIsIterationInvariantRate);
}

void register_place(const Place& place) {
  const auto add = [&](const std::string& what, const std::function<void(benchmark::State&)>& run) {
    benchmark::RegisterBenchmark((place.name + "/" + what).c_str(), run)
        ->Unit(benchmark::kMillisecond)
        ->UseRealTime();
  };
  for (const int threads : {1, 2}) {
    const std::string suffix = "/threads:" + std::to_string(threads);
    add("branch_and_bound" + suffix,
        [&place, threads](benchmark::State& s) { time_latency(s, place, threads); });
    add("batch" + suffix, [&place, threads](benchmark::State& s) { time_batch(s, place, threads); });
  }
  if (place.map.grid().cells.size() < most_cells_exhaustive)
    add("exhaustive/threads:2", [&place](benchmark::State& s) { time_exhaustive(s, place, 2); });
  add("prepare", [&place](benchmark::State& s) { time_prepare(s, place); });
}

std::vector<Place> places() {
  std::vector<Place> all;
  all.push_back(office_place());
  if (!testing::has_data()) {
    std::fprintf(stderr, "no real data: set LANDFALL_DATA\n");
    return all;
  }
  for (const char* name : {"intel", "csail", "aces", "acapulco", "infinite_corridor"})
    all.push_back(building_place(name));
  return all;
}

}  // namespace
}  // namespace landfall::bench

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  const std::vector<landfall::bench::Place> places = landfall::bench::places();
  for (const landfall::bench::Place& place : places) {
    if (!landfall::bench::equals_exhaustive(place)) return 1;
    landfall::bench::register_place(place);
  }
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}
