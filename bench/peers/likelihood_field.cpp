#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <vector>

#include "bench/peers/comparisons.hpp"
#include "bench/peers/mrpt.hpp"
#include "bench/peers/sampled_scans.hpp"
#include "kernels/score_row.hpp"

namespace landfall::bench {
namespace {

using internal::EndPoints;
using internal::HeadingCells;

// The poses of some rows in the middle of a map, at one heading.
struct Task : SampledScans {
  static constexpr int rows = 8;

  int first_row;
  int heading;

  explicit Task(const Place& place)
      : SampledScans(place), first_row((lattice.height_cells - rows) / 2), heading(lattice.headings / 7) {}
  [[nodiscard]] std::size_t poses() const {
    return static_cast<std::size_t>(rows) * static_cast<std::size_t>(lattice.width_cells);
  }
};

std::vector<double> in_metres(const std::vector<double>& cells, double resolution_m) {
  std::vector<double> metres(cells);
  for (double& value : metres) value *= resolution_m;
  return metres;
}

using MrptMaps = std::vector<MrptMap>;  // one a scan

MrptMaps make_mrpt_maps(const Task& task) {
  MrptMaps maps;
  for (const EndPoints& points : task.scans) {
    const double resolution_m = task.lattice.resolution_m;
    maps.emplace_back(task.map).set_points(in_metres(points.x_cells, resolution_m),
                                           in_metres(points.y_cells, resolution_m));
  }
  return maps;
}

void evaluate(const Task& task, const MrptMap& peer, std::vector<double>& log_likelihoods) {
  const double theta_rad = task.lattice.heading_grid_rad(task.heading);
  std::size_t i = 0;
  for (int row = task.first_row; row < task.first_row + Task::rows; ++row)
    for (int col = 0; col < task.lattice.width_cells; ++col)
      log_likelihoods[i++] = peer.log_mean_likelihood({.x_m = (col + 0.5) * task.lattice.resolution_m,
                                                       .y_m = (row + 0.5) * task.lattice.resolution_m,
                                                       .theta_rad = theta_rad});
}

void evaluate(const Task& task, const EndPoints& points, std::vector<std::int32_t>& scores) {
  HeadingCells cells;
  internal::cells_at_heading(points, task.lattice, task.heading, cells);
  const int width = task.lattice.width_cells;
  std::vector<std::uint16_t> partial(static_cast<std::size_t>(width));
  std::fill(scores.begin(), scores.end(), 0);
  for (int row = 0; row < Task::rows; ++row)
    kernels::score_row(task.map.field().data(), width, task.lattice.height_cells, task.first_row + row,
                       cells.col.data(), cells.row.data(), points.size(), partial.data(),
                       scores.data() + std::ptrdiff_t{row} * width);
}

// But for poses that see the border of the map: within a cell of it MRPT takes end points for others.
bool same_likelihoods(const Place& place, const Task& task, const MrptMaps& peers) {
  constexpr double tolerance = 0.01;
  constexpr double least_share = 0.9;
  std::vector<double> logs(task.poses());
  std::vector<std::int32_t> scores(task.poses());
  std::size_t agree = 0;
  for (std::size_t scan = 0; scan < Task::scan_count; ++scan) {
    evaluate(task, peers[scan], logs);
    evaluate(task, task.scans[scan], scores);
    const double best_imaginable = 255.0 * static_cast<double>(task.scans[scan].size());
    for (std::size_t i = 0; i < logs.size(); ++i)
      agree += std::abs(std::exp(logs[i]) - scores[i] / best_imaginable) < tolerance ? 1 : 0;
  }
  const double share = static_cast<double>(agree) / static_cast<double>(Task::scan_count * task.poses());
  if (share < least_share)
    std::fprintf(stderr, "%s: MRPT and landfall agree on the likelihood of %.1f %% of the poses\n",
                 place.name.c_str(), 100.0 * share);
  return share >= least_share;
}

template <class Value, class Evaluator>
void time_evaluation(benchmark::State& state, const Task& task, const std::vector<Evaluator>& by_scan) {
  std::vector<Value> values(task.poses());
  for (auto _ : state)
    for (const Evaluator& evaluator : by_scan) {
      evaluate(task, evaluator, values);
      benchmark::DoNotOptimize(values.data());
    }
  state.counters["poses/s"] = benchmark::Counter(static_cast<double>(by_scan.size() * task.poses()),
                                                 benchmark::Counter::kIsIterationInvariantRate);
}

}  // namespace

bool compare_likelihood_field(const Place& place) {
  const auto task = std::make_shared<const Task>(place);
  const auto peers = std::make_shared<const MrptMaps>(make_mrpt_maps(*task));
  if (!same_likelihoods(place, *task, *peers)) return false;
  const auto add = [&](const char* who, const auto& run) {
    benchmark::RegisterBenchmark((place.name + "/likelihood_field/" + who).c_str(), run)
        ->Unit(benchmark::kMillisecond);
  };
  add("mrpt", [task, peers](benchmark::State& state) { time_evaluation<double>(state, *task, *peers); });
  add("landfall",
      [task](benchmark::State& state) { time_evaluation<std::int32_t>(state, *task, task->scans); });
  return true;
}

}  // namespace landfall::bench
