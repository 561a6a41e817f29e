#include "bench/peers/dense_correlation.hpp"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "bench/peers/comparisons.hpp"
#include "bench/peers/sampled_scans.hpp"
#include "engine/methods/fft/correlation_search.hpp"
#include "kernels/score_row.hpp"

namespace landfall::bench {
namespace {

using internal::EndPoints;
using internal::HeadingCells;

// Each at some headings.
struct Task : SampledScans {
  static constexpr int heading_count = 4;

  using SampledScans::SampledScans;
  [[nodiscard]] std::size_t map_cells() const { return map.field().size(); }
  [[nodiscard]] int heading(int index) const {
    return (2 * index + 1) * lattice.headings / (2 * heading_count);
  }
};

// The rows of `exhaustive`.
class LandfallRows {
 public:
  explicit LandfallRows(const PreparedMap& map)
      : map_(map), partial_(static_cast<std::size_t>(map.grid().width_cells)) {}

  void correlate(const HeadingCells& cells, std::span<std::int32_t> sums) {
    std::fill(sums.begin(), sums.end(), 0);
    const int width = map_.grid().width_cells;
    const int height = map_.grid().height_cells;
    for (int row = 0; row < height; ++row)
      kernels::score_row(map_.field().data(), width, height, row, cells.col.data(), cells.row.data(),
                         cells.col.size(), partial_.data(), sums.data() + std::ptrdiff_t{row} * width);
  }

 private:
  const PreparedMap& map_;
  std::vector<std::uint16_t> partial_;
};

template <class Correlation, class Sum>
void correlate_at(const Task& task, std::size_t scan, int heading, Correlation& by, std::vector<Sum>& sums) {
  HeadingCells cells;
  internal::cells_at_heading(task.scans[scan], task.lattice, task.heading(heading), cells);
  by.correlate(cells, sums);
}

// A correlator for each scan: transforms are as large as the scan needs.
using Correlators = std::vector<std::unique_ptr<DenseCorrelation>>;

bool same_sums(const Place& place, const Task& task, const char* who, const Correlators& peer) {
  constexpr float rounding = 0.5F;
  LandfallRows ours(task.map);
  std::vector<float> sums(task.map_cells());
  std::vector<std::int32_t> expected(task.map_cells());
  for (std::size_t scan = 0; scan < Task::scan_count; ++scan)
    for (int heading = 0; heading < Task::heading_count; ++heading) {
      correlate_at(task, scan, heading, *peer[scan], sums);
      correlate_at(task, scan, heading, ours, expected);
      for (std::size_t i = 0; i < sums.size(); ++i) {
        if (std::abs(sums[i] - static_cast<float>(expected[i])) < rounding) continue;
        std::fprintf(stderr, "%s, scan %zu, heading %d, pose %zu: %s sums up %f, landfall %d\n",
                     place.name.c_str(), scan, heading, i, who, static_cast<double>(sums[i]), expected[i]);
        return false;
      }
    }
  return true;
}

template <class Sum, class CorrelatorOf>
void time_correlation(benchmark::State& state, const Task& task, const CorrelatorOf& correlator_of) {
  std::vector<Sum> sums(task.map_cells());
  for (auto _ : state)
    for (std::size_t scan = 0; scan < Task::scan_count; ++scan)
      for (int heading = 0; heading < Task::heading_count; ++heading) {
        correlate_at(task, scan, heading, correlator_of(scan), sums);
        benchmark::DoNotOptimize(sums.data());
      }
  state.counters["poses/s"] =
      benchmark::Counter(static_cast<double>(Task::scan_count * Task::heading_count * task.map_cells()),
                         benchmark::Counter::kIsIterationInvariantRate);
}

}  // namespace

bool compare_dense_correlation(const Place& place) {
  const auto task = std::make_shared<const Task>(place);
  const auto add = [&](const char* who, const auto& run) {
    benchmark::RegisterBenchmark((place.name + "/dense_correlation/" + who).c_str(), run)
        ->Unit(benchmark::kMillisecond);
  };
  [[maybe_unused]] const auto add_peer = [&](const char* who, const auto& make) {
    const auto peer = std::make_shared<Correlators>();
    for (const EndPoints& points : task->scans)
      peer->push_back(make(task->map, internal::reach_cells(points)));
    if (!same_sums(place, *task, who, *peer)) return false;
    add(who, [task, peer](benchmark::State& state) {
      time_correlation<float>(
          state, *task, [&](std::size_t scan) -> auto& { return *(*peer)[scan]; });
    });
    return true;
  };
#if LANDFALL_BENCH_OPENCV
  if (!add_peer("opencv", opencv_correlation)) return false;
#endif
#if LANDFALL_BENCH_FFTW
  if (!add_peer("fftw", fftw_correlation)) return false;
#endif
  add("landfall", [task](benchmark::State& state) {
    LandfallRows ours(task->map);
    time_correlation<std::int32_t>(
        state, *task, [&](std::size_t) -> auto& { return ours; });
  });
  return true;
}

}  // namespace landfall::bench
