#include "landfall/diffusion.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <span>
#include <string>

#include "engine/base/number_text.hpp"
#include "engine/base/options.hpp"
#include "engine/methods/sdn/find_modes_by_diffusion.hpp"
#include "engine/priors/off_map.hpp"
#include "landfall/error.hpp"

namespace landfall {
namespace {

using namespace internal;

constexpr int most_cells = 1 << 20;
constexpr int most_modes = 1000;

void require(bool holds, const std::string& what) {
  if (!holds) throw Error(ErrorCode::invalid_argument, "run_diffusion: option " + what);
}

void validate(const DiffusionOptions& options) {
  require(options.cells >= 0 && options.cells <= most_cells,
          "cells is " + std::to_string(options.cells) + ", expected 0 to " + std::to_string(most_cells));
  require(std::isfinite(options.top_half_m) && options.top_half_m >= 0.0,
          "top_half_m is " + number_text(options.top_half_m) + ", expected 0 or more");
  require(std::isfinite(options.top_half_rad) && options.top_half_rad >= 0.0,
          "top_half_rad is " + number_text(options.top_half_rad) + ", expected 0 or more");
  require((options.top_half_m > 0.0) == (options.top_half_rad > 0.0),
          "top_half_m and top_half_rad: expected both or neither");
  require(
      options.max_modes >= 1 && options.max_modes <= most_modes,
      "max_modes is " + std::to_string(options.max_modes) + ", expected 1 to " + std::to_string(most_modes));
  for (const int iteration : options.snapshot_iterations)
    require(iteration >= 0, "snapshot_iterations has " + std::to_string(iteration) + ", expected 0 or more");
}

// The first one, of initialisation and its tests, is iteration 0.
int iteration_of(const Network& network) {
  return static_cast<int>(network.iterations()) - 1;
}

DiffusionSnapshot snapshot_of(const Network& network) {
  DiffusionSnapshot snapshot{.iteration = iteration_of(network)};
  const Cells& cells = network.cells();
  for (std::size_t i = 0; i < cells.size(); ++i) {
    snapshot.T_map_robot.push_back(cells.mapping(i).T_map_robot);
    snapshot.level.push_back(static_cast<std::uint8_t>(cells.level(i)));
    snapshot.active.push_back(cells.mapping(i).active ? 1 : 0);
  }
  return snapshot;
}

double ms_between(Clock::time_point start, Clock::time_point end) {
  return std::chrono::duration<double, std::milli>(end - start).count();
}

// The first network as it goes on.
class Observer {
 public:
  Observer(const std::vector<int>& iterations, DiffusionRun& run) : iterations_(iterations), run_(run) {}

  void operator()(const Network& network, std::uint32_t number) {
    if (number > 0) return;
    first_network_end_ = Clock::now();
    if (std::find(iterations_.begin(), iterations_.end(), iteration_of(network)) != iterations_.end())
      run_.snapshots.push_back(snapshot_of(network));
    else if (!iterations_.empty())
      latest_ = snapshot_of(network);
  }
  void finish() {
    const bool kept = !run_.snapshots.empty() && run_.snapshots.back().iteration >= latest_.iteration;
    if (!kept) run_.snapshots.push_back(std::move(latest_));
  }
  [[nodiscard]] Clock::time_point first_network_end() const { return first_network_end_; }

 private:
  const std::vector<int>& iterations_;
  DiffusionRun& run_;
  DiffusionSnapshot latest_;
  Clock::time_point first_network_end_ = Clock::now();
};

void take(const DiffusionAnswer& answer, DiffusionRun& run) {
  run.modes = answer.modes;
  for (const FocusLevel& level : answer.levels) run.levels.push_back({level.half_m, level.half_rad});
  run.regions = answer.regions;
  run.cells = static_cast<int>(answer.cells);
  run.iterations = answer.iterations;
  run.draws = answer.counts.draws;
  run.rays_cast = answer.counts.tests;
  run.cast_ms = answer.counts.cast_ms;
  run.processor_ms = answer.counts.step_ms;
}

}  // namespace

DiffusionRun run_diffusion(const PreparedMap& map, const PosePrior& prior, const Scan& scan,
                           const DiffusionOptions& options) {
  validate(options);
  validate(prior);
  validate(scan);
  validate_environment();
  SearchOptions search_options{.max_hypotheses = options.max_modes,
                               .time_budget_s = options.time_budget_s,
                               .threads = options.threads,
                               .seed = options.seed};
  validate(search_options);
  (void)map.state().scene();
  const Lattice lattice = make_lattice(map.grid(), 0.0, search_options.rotation_step_rad);
  const Domain domain = make_domain(prior, lattice, map.state().free_mask(0.0, 1));
  if (!domain.on_map)
    throw Error(ErrorCode::invalid_argument, off_map_text(std::span(&prior, 1), 0, std::span(&map, 1)));
  DiffusionRun run;
  if (domain.poses == 0 || count_valid(scan) == 0) return run;
  const Clock::time_point start = Clock::now();
  Observer observer(options.snapshot_iterations, run);
  const DiffusionSettings settings{
      .focused = options.focused,
      .cells = static_cast<std::size_t>(options.cells),
      .top = {.half_m = options.top_half_m, .half_rad = options.top_half_rad},
      .most_modes = static_cast<std::size_t>(options.max_modes),
      .measure_time = true,
      .observe = [&observer](const Network& network, std::uint32_t number) { observer(network, number); }};
  const EndPoints points = make_end_points(scan, lattice.resolution_m);
  const Query query{.map = map.state(),
                    .scan = scan,
                    .points = points,
                    .lattice = lattice,
                    .domain = domain,
                    .options = search_options,
                    .threads = options.threads,
                    .deadline = deadline_of(start, options.time_budget_s)};
  take(find_modes_by_diffusion(query, settings), run);
  if (!options.snapshot_iterations.empty()) observer.finish();
  run.first_mode_ms = ms_between(start, observer.first_network_end());
  run.total_ms = ms_between(start, Clock::now());
  return run;
}

}  // namespace landfall
