#include "engine/methods/sdn/network.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "engine/base/parallel.hpp"
#include "engine/base/thread_time.hpp"

namespace landfall::internal {
namespace {

constexpr std::size_t chunk_cells = TestRays::most_tests;
// Levels that a cell moves up where its beam would have passed through a wall. The paper moves it up one, as
// where something stands before the wall; so, cold starts cast half as many rays (bench/RESULTS.md).
constexpr std::size_t levels_behind_wall = 2;

}  // namespace

bool Excluded::contains(const Pose2& T_map_robot) const {
  return std::any_of(T_map_mode.begin(), T_map_mode.end(), [&](const Pose2& T_map_one) {
    return std::abs(T_map_one.x_m - T_map_robot.x_m) <= reach.half_m &&
           std::abs(T_map_one.y_m - T_map_robot.y_m) <= reach.half_m &&
           angle_distance(T_map_one.theta_rad, T_map_robot.theta_rad) <= reach.half_rad;
  });
}

void NetworkCounts::add(const NetworkCounts& other) {
  draws += other.draws;
  copies += other.copies;
  tests += other.tests;
  active += other.active;
  focused += other.focused;
  cast_ms += other.cast_ms;
  step_ms += other.step_ms;
}

Network::Network(const SearchSpace& space, const Excluded& excluded, const NetworkOptions& options)
    : space_(space), excluded_(excluded), options_(options), cells_(options.cells, space.levels) {}

const Mapping& Network::poll(std::size_t cell, CounterRng& rng) const {
  const auto others = static_cast<std::uint32_t>(cells_.size() - 1);
  const std::uint32_t other = others == 0 ? 0 : rng.below(others);
  return cells_.mapping(other < cell || others == 0 ? other : other + 1);
}

// 2, diffusion: an inactive cell polls another one at random, copies its mapping where that is active, and
// else draws a new one. Initialisation is a draw for every cell.
void Network::diffuse(std::size_t cell, CounterRng& rng, NetworkCounts& counts) {
  if (iteration_ > 0) {
    if (cells_.mapping(cell).active) return;
    const Mapping& polled = poll(cell, rng);
    if (polled.active) {
      cells_.copy(cell, polled.T_map_robot, rng);
      ++counts.copies;
      return;
    }
  }
  const PoseSampler::Drawn drawn = space_.sampler.draw_with_component(rng);
  cells_.place(cell, drawn.T_map_robot, space_.start_levels[drawn.component]);
  ++counts.draws;
}

NetworkCounts Network::step_chunk(std::size_t first, std::size_t count) {
  const auto now_ms = [&] { return options_.measure_time ? thread_time_ms() : 0.0; };
  const double start_ms = now_ms();
  NetworkCounts counts;
  std::array<Test, chunk_cells> tests;
  std::array<float, chunk_cells> simulated_m;
  const auto rng_of = [&](std::size_t cell, std::uint32_t phase) {
    return CounterRng(options_.seed, options_.run, static_cast<std::uint32_t>(cell), 2 * iteration_ + phase);
  };
  for (std::size_t i = 0; i < count; ++i) {
    CounterRng rng = rng_of(first + i, 0);
    const std::uint32_t beam = rng.below(static_cast<std::uint32_t>(space_.bands.size()));
    diffuse(first + i, rng, counts);
    tests[i] = {.T_map_robot = cells_.T_map_robot(first + i), .beam = beam};
  }
  const double cast_start_ms = now_ms();
  space_.rays.cast(std::span(tests).first(count), simulated_m);
  counts.cast_ms = now_ms() - cast_start_ms;
  counts.tests = static_cast<std::int64_t>(count);
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t cell = first + i;
    const std::size_t level = cells_.level(cell);
    const Band& band = space_.bands.band(level, tests[i].beam);
    const bool passed = band.contains(simulated_m[i]) && !excluded_.contains(tests[i].T_map_robot);
    if (passed) {
      CounterRng rng = rng_of(cell, 1);
      counts.focused += level == cells_.finest() ? 1 : 0;
      cells_.pass(cell, poll(cell, rng), rng);
    } else {
      cells_.fail(cell, band.passes_wall(simulated_m[i]) ? levels_behind_wall : 1);
    }
    counts.active += cells_.is_active(cell) ? 1 : 0;
  }
  counts.step_ms = now_ms() - start_ms;
  return counts;
}

void Network::step() {
  const std::size_t chunks = (cells_.size() + chunk_cells - 1) / chunk_cells;
  std::vector<NetworkCounts> counts(chunks);
  parallel_for(chunks, options_.threads, [&](std::size_t chunk) {
    const std::size_t first = chunk * chunk_cells;
    counts[chunk] = step_chunk(first, std::min(chunk_cells, cells_.size() - first));
  });
  counts_.active = counts_.focused = 0;
  for (const NetworkCounts& one : counts) counts_.add(one);
  cells_.publish();
  ++iteration_;
}

}  // namespace landfall::internal
