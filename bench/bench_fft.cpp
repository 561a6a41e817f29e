// Method fft: the paper's volume beside bare transforms of the same size, real and made-up places beside
// branch and bound, and what the cost model's constants come from. Answers are checked before they are timed.
#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdio>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "bench/places.hpp"
#include "engine/maps/prepared_state.hpp"
#include "engine/methods/fft/bare_transforms.hpp"
#include "engine/methods/fft/correlation_search.hpp"
#include "engine/methods/fft/correlator.hpp"
#include "engine/methods/fft/exact_blocks.hpp"
#include "landfall/correlation.hpp"

namespace landfall::bench {
namespace {

const PosePrior anywhere{Anywhere{}};

// A scan of a place as method fft sees it; all threads of the machine, unless said.
struct Question {
  const Place& place;
  const Scan& scan;
  SearchOptions options{};
  internal::Lattice lattice = internal::make_lattice(place.map.grid(), 0.0, options.rotation_step_rad);
  internal::EndPoints points = internal::make_end_points(scan, lattice.resolution_m);
  internal::Domain domain =
      internal::make_domain(anywhere, lattice, place.map.state().free_mask(0.0, lattice.step_cells));

  [[nodiscard]] internal::Query query(int threads) const {
    return {.map = place.map.state(),
            .scan = scan,
            .points = points,
            .lattice = lattice,
            .domain = domain,
            .options = options,
            .margin = internal::rival_margin(points.size()),
            .threads = threads,
            .deadline = {}};
  }
};

void add(const std::string& name, const std::function<void(benchmark::State&)>& run, int iterations = 0) {
  auto* added = benchmark::RegisterBenchmark(name.c_str(), run)->Unit(benchmark::kMillisecond)->UseRealTime();
  if (iterations > 0) added->Iterations(iterations)->Repetitions(1);
}

// What one thread does, by its processor time: other work of the machine hardly shows in it.
void add_of_one_thread(const std::string& name, const std::function<void(benchmark::State&)>& run) {
  benchmark::RegisterBenchmark(name.c_str(), run)->Unit(benchmark::kMillisecond);
}

// The best scores of both ways are branch and bound's.
bool equals_branch_and_bound(const Place& place) {
  const Scan& scan = place.scans.front();
  const std::int64_t expected = best_score(search(place.map, anywhere, scan));
  const Question question{.place = place, .scan = scan};
  for (const auto& propose : {internal::propose_by_transforms, internal::propose_directly}) {
    const internal::Proposal proposal = propose(question.query(0));
    if (!proposal.candidates.empty() && proposal.candidates.front().score == expected) continue;
    std::fprintf(stderr, "%s, %s: not branch and bound's best score, %lld\n", place.name.c_str(),
                 proposal.way.c_str(), static_cast<long long>(expected));
    return false;
  }
  return true;
}

void register_place(const Place& place) {
  const auto by_scan = [&place](const char* method) {
    return [&place, method](benchmark::State& state) {
      for (auto _ : state) {
        const SearchResult result =
            search(place.map, anywhere, place.scans.front(), {.method = method, .threads = 2});
        state.SetLabel(result.method);
      }
    };
  };
  add(place.name + "/branch_and_bound/threads:2", by_scan("branch_and_bound"));
  add(place.name + "/fft/threads:2", by_scan("fft"));
  add(
      place.name + "/fft/transforms/threads:2",
      [&place](benchmark::State& state) {
        const Question question{.place = place, .scan = place.scans.front()};
        for (auto _ : state) benchmark::DoNotOptimize(internal::propose_by_transforms(question.query(2)));
      },
      1);
}

// 128 x 128 cells of a place, as many headings as the paper's: the whole volume, and the transforms alone.
bool register_papers_volume(const Place& place) {
  constexpr int side = 128;
  constexpr int headings = 64;
  GridMap grid = place.map.grid();
  grid.width_cells = grid.height_cells = side;
  grid.cells.clear();
  for (int row = 0; row < side; ++row)
    for (int col = 0; col < side; ++col) grid.cells.push_back(place.map.grid().at({col, row}));
  static PreparedMap map(grid);
  static const Scan scan = place.scans.front();
  const CorrelationOptions options{.rotation_step_rad = 2.0 * std::numbers::pi / headings, .threads = 1};
  const CorrelationVolume volume = correlation_volume(map, scan, options);
  const SearchResult expected =
      search(map, anywhere, scan, {.method = "exhaustive", .rotation_step_rad = options.rotation_step_rad});
  float most = 0.0F;
  for (int heading = 0; heading < headings; ++heading)
    for (int row = 0; row < side; ++row)
      for (int col = 0; col < side; ++col)
        if (grid.at({col, row}) == Occupancy::free) most = std::max(most, volume.at(heading, {col, row}));
  if (std::lround(most) != best_score(expected)) {
    std::fprintf(stderr, "the volume's maximum is %f, exhaustive's %lld\n", static_cast<double>(most),
                 static_cast<long long>(best_score(expected)));
    return false;
  }
  const auto by_threads = [options](int threads) {
    return [options, threads](benchmark::State& state) {
      CorrelationOptions own = options;
      own.threads = threads;
      for (auto _ : state) benchmark::DoNotOptimize(correlation_volume(map, scan, own));
    };
  };
  add_of_one_thread("volume/128x128x64/cpu", by_threads(1));
  for (const int threads : {1, 2})
    add("volume/128x128x64/threads:" + std::to_string(threads), by_threads(threads));
  const int rows = volume.transform_rows;
  const int cols = volume.transform_cols;
  const std::string size = std::to_string(rows) + "x" + std::to_string(cols) + "x64";
  const auto bare = [rows, cols](benchmark::State& state) {
    internal::BareTransforms transforms(rows, cols);
    for (auto _ : state) transforms.run(headings);
  };
  add_of_one_thread("bare_transforms/" + size + "/cpu", bare);
  add("bare_transforms/" + size, bare);
  return true;
}

// cost_model.hpp: time per real and level of a transform, and per block and point of direct sums.
void register_cost_model(const Place& place) {
  for (const int side : {128, 256, 512, 1024, 2048, 4096})
    add_of_one_thread("cost_model/transform/" + std::to_string(side), [side](benchmark::State& state) {
      const std::vector<float> field(static_cast<std::size_t>(side / 2) * static_cast<std::size_t>(side / 2),
                                     1.0F);
      const internal::MapSpectra spectra(field, internal::whole_map(side / 2, side / 2, side / 2));
      internal::Correlator correlator(spectra);
      const internal::HeadingCells points{.col = std::vector<std::int32_t>(180, 3),
                                          .row = std::vector<std::int32_t>(180, 5)};
      for (auto _ : state) {
        correlator.draw(points);
        correlator.correlate(0);
      }
      const double reals = static_cast<double>(side) * side;
      state.counters["per_real_and_level"] =
          benchmark::Counter(2.0 * reals * std::log2(reals),
                             benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
    });
  add_of_one_thread("cost_model/direct", [&place](benchmark::State& state) {
    const Question question{.place = place,
                            .scan = place.scans.front(),
                            .options = {.rotation_step_rad = std::numbers::pi / 12.0}};
    double blocks = 0.0;
    for (const internal::SharedMask& mask : question.domain.mask_of_heading)
      for (const std::uint64_t word : mask->words) blocks += word != 0 ? 1.0 : 0.0;
    for (auto _ : state) benchmark::DoNotOptimize(internal::propose_directly(question.query(1)));
    state.counters["per_block_and_point"] =
        benchmark::Counter(blocks * static_cast<double>(question.points.size()),
                           benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
  });
}

}  // namespace
}  // namespace landfall::bench

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  const std::vector<landfall::bench::Place> places = landfall::bench::office_and({"intel"});
  const landfall::bench::Place& place = places.back();  // intel, where data are
  if (!landfall::bench::register_papers_volume(place)) return 1;
  if (!landfall::bench::equals_branch_and_bound(place)) return 1;
  landfall::bench::register_place(place);
  landfall::bench::register_cost_model(place);
  benchmark::AddCustomContext("transforms", std::string(landfall::transform_library()));
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}
