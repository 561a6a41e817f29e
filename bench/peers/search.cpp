#include <benchmark/benchmark.h>

#include <cstdio>
#include <memory>

#include "bench/peers/comparisons.hpp"
#include "bench/peers/textbook.hpp"
#include "engine/base/thread_time.hpp"

namespace landfall::bench {
namespace {

const PosePrior anywhere{Anywhere{}};
const SearchOptions ours{.method = "branch_and_bound", .threads = 1};

double median_ms(const Textbook& textbook, const internal::Lattice& lattice, const std::vector<Scan>& scans) {
  std::vector<double> search_ms;
  for (const Scan& scan : scans) {
    const double start_ms = internal::thread_time_ms();
    const internal::EndPoints points = internal::make_end_points(scan, lattice.resolution_m);
    benchmark::DoNotOptimize(textbook.search(points, lattice));
    search_ms.push_back(internal::thread_time_ms() - start_ms);
  }
  return quantile(search_ms, 0.5);
}

// The textbook at its best: the height that is fastest on some of the place's scans.
struct TextbookAtItsBest {
  internal::Lattice lattice;
  std::unique_ptr<const Textbook> textbook;
  int height = 0;

  explicit TextbookAtItsBest(const Place& place)
      : lattice(internal::make_lattice(place.map.grid(), ours.translation_step_m, ours.rotation_step_rad)) {
    std::vector<Scan> some;
    for (std::size_t i = 0; i < place.scans.size(); i += 4) some.push_back(place.scans[i]);
    double best_ms = 0.0;
    for (int h = 4; h <= 7; ++h) {
      auto candidate = std::make_unique<const Textbook>(place.map, h);
      const double ms = median_ms(*candidate, lattice, some);
      if (textbook != nullptr && ms >= best_ms) continue;
      textbook = std::move(candidate);
      height = h;
      best_ms = ms;
    }
  }
};

bool same_best_score(const Place& place, const TextbookAtItsBest& peer) {
  SearchOptions options = ours;
  options.max_hypotheses = 8;  // the best score among them, which probability may not put first
  for (std::size_t i = 0; i < place.scans.size(); ++i) {
    const std::int64_t expected = best_score(search(place.map, anywhere, place.scans[i], options));
    const internal::EndPoints points = internal::make_end_points(place.scans[i], peer.lattice.resolution_m);
    const std::int64_t score = peer.textbook->search(points, peer.lattice).score;
    if (score == expected) continue;
    std::fprintf(stderr, "%s, scan %zu: the textbook scores %lld, landfall %lld\n", place.name.c_str(), i,
                 static_cast<long long>(score), static_cast<long long>(expected));
    return false;
  }
  return true;
}

void time_textbook(benchmark::State& state, const Place& place, const TextbookAtItsBest& peer) {
  std::vector<double> search_ms;
  double nodes = 0.0;
  for (auto _ : state)
    for (const Scan& scan : place.scans) {
      const double start_ms = internal::thread_time_ms();
      const internal::EndPoints points = internal::make_end_points(scan, peer.lattice.resolution_m);
      nodes += static_cast<double>(peer.textbook->search(points, peer.lattice).nodes);
      search_ms.push_back(internal::thread_time_ms() - start_ms);
    }
  state.counters["nodes/scan"] = nodes / static_cast<double>(search_ms.size());
  state.counters["median_ms"] = quantile(search_ms, 0.5);
  state.SetLabel("2^" + std::to_string(peer.height) + " cells at the root");
}

// The whole of search(): rivals, refinement and verification too.
void time_landfall(benchmark::State& state, const Place& place) {
  std::vector<double> search_ms;
  for (auto _ : state)
    for (const Scan& scan : place.scans) {
      const double start_ms = internal::thread_time_ms();
      const SearchResult result = search(place.map, anywhere, scan, ours);
      search_ms.push_back(internal::thread_time_ms() - start_ms);
      state.SetLabel(result.method);
    }
  state.counters["median_ms"] = quantile(search_ms, 0.5);
}

}  // namespace

bool compare_search(const Place& place) {
  const auto peer = std::make_shared<const TextbookAtItsBest>(place);
  if (!same_best_score(place, *peer)) return false;
  const auto add = [&](const char* who, const auto& run) {
    benchmark::RegisterBenchmark((place.name + "/search/" + who).c_str(), run)->Unit(benchmark::kMillisecond);
  };
  add("textbook", [&place, peer](benchmark::State& state) { time_textbook(state, place, *peer); });
  add("landfall", [&place](benchmark::State& state) { time_landfall(state, place); });
  return true;
}

}  // namespace landfall::bench
