// The search as users meet it: latency of a scan, scans a second, preparation, and the exhaustive oracle.
// On a made-up office, and where the data are on a sample of each building's queries, no prior. Branch and
// bound is held to exhaustive search on a coarse lattice of each place before anything is timed.
#include <benchmark/benchmark.h>

#include <cstdio>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "bench/context.hpp"
#include "bench/places.hpp"
#include "tests/executors.hpp"
#include "tests/instruction_sets.hpp"

namespace landfall::bench {
namespace {

constexpr double coarse_rotation_step_rad = std::numbers::pi / 12.0;  // 15 degrees
constexpr std::size_t most_cells_exhaustive = 1'000'000;              // on larger maps it takes seconds
const PosePrior anywhere{Anywhere{}};

bool equals_exhaustive(const Place& place) {
  for (const std::size_t i : {std::size_t{0}, scans_per_place / 2}) {
    SearchOptions options{.rotation_step_rad = coarse_rotation_step_rad, .max_hypotheses = 8};
    options.method = "exhaustive";
    const SearchResult expected = search(place.map, anywhere, place.scans[i], options);
    options.method = "branch_and_bound";
    const SearchResult result = search(place.map, anywhere, place.scans[i], options);
    if (best_score(result) == best_score(expected) && result.proven) continue;
    std::fprintf(stderr, "%s, scan %zu: branch and bound scores %lld, exhaustive %lld\n", place.name.c_str(),
                 i, static_cast<long long>(best_score(result)), static_cast<long long>(best_score(expected)));
    return false;
  }
  return true;
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

void add(const Place& place, const std::string& what, const std::function<void(benchmark::State&)>& run) {
  benchmark::RegisterBenchmark((place.name + "/" + what).c_str(), run)
      ->Unit(benchmark::kMillisecond)
      ->UseRealTime();
}

void register_place(const Place& place) {
  for (const int threads : {1, 2}) {
    const std::string suffix = "/threads:" + std::to_string(threads);
    add(place, "branch_and_bound" + suffix,
        [&place, threads](benchmark::State& s) { time_latency(s, place, threads); });
    add(place, "batch" + suffix, [&place, threads](benchmark::State& s) { time_batch(s, place, threads); });
  }
  if (place.map.grid().cells.size() < most_cells_exhaustive)
    add(place, "exhaustive/threads:2", [&place](benchmark::State& s) { time_exhaustive(s, place, 2); });
  add(place, "prepare", [&place](benchmark::State& s) { time_prepare(s, place); });
}

bool same_hypotheses(const SearchResult& a, const SearchResult& b) {
  const auto same = [](const Hypothesis& one, const Hypothesis& other) {
    return one.score == other.score && one.T_map_robot_unrefined == other.T_map_robot_unrefined;
  };
  return a.proven == b.proven &&
         std::equal(a.hypotheses.begin(), a.hypotheses.end(), b.hypotheses.begin(), b.hypotheses.end(), same);
}

// Whole searches in one thread on every instruction set, each held to the best one's answers.
bool register_instruction_sets(const Place& place) {
  const SearchOptions options{.method = "branch_and_bound", .threads = 1};
  const Scan& scan = place.scans.front();
  const SearchResult expected = search(place.map, anywhere, scan, options);
  for (const std::string& isa : testing::instruction_sets()) {
    const testing::UsedInstructionSet proven(isa);
    if (!same_hypotheses(search(place.map, anywhere, scan, options), expected)) {
      std::fprintf(stderr, "%s: %s answers otherwise\n", place.name.c_str(), isa.c_str());
      return false;
    }
    add(place, "branch_and_bound/isa:" + isa, [&place, isa](benchmark::State& state) {
      const testing::UsedInstructionSet used(isa);
      time_latency(state, place, 1);
    });
  }
  return true;
}

// One scan after the other, and all in one call, on two threads of each scheduler.
void register_executors(const Place& place) {
  for (const std::string& executor : testing::executor_names()) {
    const std::string suffix = "/threads:2/executor:" + executor;
    add(place, "branch_and_bound" + suffix, [&place, executor](benchmark::State& state) {
      const testing::UsedExecutor used(executor);
      time_latency(state, place, 2);
    });
    add(place, "batch" + suffix, [&place, executor](benchmark::State& state) {
      const testing::UsedExecutor used(executor);
      time_batch(state, place, 2);
    });
  }
}

}  // namespace
}  // namespace landfall::bench

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  landfall::bench::name_instruction_set_and_executor();
  const std::vector<landfall::bench::Place> places =
      landfall::bench::office_and({"intel", "csail", "aces", "acapulco", "infinite_corridor"});
  for (const landfall::bench::Place& place : places) {
    if (!landfall::bench::equals_exhaustive(place)) return 1;
    landfall::bench::register_place(place);
  }
  const landfall::bench::Place& compared = places[places.size() > 1 ? 1 : 0];  // intel, where data are
  if (!landfall::bench::register_instruction_sets(compared)) return 1;
  landfall::bench::register_executors(compared);
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}
