#include "engine/methods/sdn/find_modes_by_diffusion.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "engine/base/parallel.hpp"
#include "engine/base/thread_time.hpp"
#include "engine/methods/sdn/choose_parameters.hpp"
#include "engine/methods/sdn/cluster.hpp"
#include "engine/methods/sdn/equilibrium.hpp"

namespace landfall::internal {
namespace {

// A cluster is as wide as the finest level's tests let it be.
constexpr FocusLevel cluster_reach{.half_m = 0.1, .half_rad = 0.06};
// A mode that explains less than this part of the best one does not explain as well.
constexpr double as_well = 0.85;
// A mode that explains so many beams is taken to be one.
constexpr double good = 0.8;
// Cells may settle beside a mode that is excluded before they find a rival.
constexpr std::ptrdiff_t enough_worse = 3;
// 2.2 asks for equilibrium among cells at the finest level. Where most cells have been active for long
// without it, they hold each other in places that fit at the coarser levels alone, and hardly draw new
// mappings (with half of them active, one test in four): the largest such place is a mode too, a bad one,
// without which the next network goes on.
constexpr double saturation = 0.5;
constexpr int most_saturated = 240;
// Networks side by side that look for rivals of a good mode, each with its part of the draws: so many at any
// number of threads, for the same answer.
constexpr std::uint32_t rival_networks = 2;

// The networks of one query.
class DiffusionSearch {
 public:
  DiffusionSearch(const Query& query, const DiffusionSettings& settings)
      : query_(query),
        settings_(settings),
        sampler_(query.lattice, query.domain),
        levels_(make_levels(sampler_, settings)),
        start_levels_(start_levels(sampler_, levels_)),
        bands_(query.scan, levels_,
               {.region_share = settings.region_share, .map_noise_m = map_noise_m(query.map)}),
        rays_(query.map, query.scan, bands_),
        regions_(std::max(1.0, sampler_.volume() / volume_of(levels_.front()))),
        cells_(settings.cells > 0 ? settings.cells : choose_cells(regions_)) {}

  DiffusionAnswer run() {
    const Clock::time_point start = Clock::now();
    answer_.levels = levels_;
    answer_.regions = regions_;
    answer_.cells = cells_;
    answer_.beams = static_cast<int>(bands_.size());
    std::uint32_t number = 0;
    while (answer_.modes.size() < settings_.most_modes) {
      const std::size_t known = answer_.modes.size();
      const std::uint32_t networks = has_good_mode() ? rival_networks : 1;
      run_networks(number, networks);
      number += networks;
      const double found_ms = std::chrono::duration<double, std::milli>(Clock::now() - start).count();
      for (std::size_t i = known; i < answer_.modes.size(); ++i) {
        answer_.modes[i].found_ms = found_ms;
        answer_.modes[i].found_processor_ms = answer_.counts.step_ms;
        answer_.modes[i].found_rays_cast = answer_.counts.tests;
      }
      if (answer_.modes.size() == known || none_explains_as_well()) break;
    }
    return std::move(answer_);
  }

 private:
  struct Outcome {
    std::optional<DiffusionMode> mode{};
    NetworkCounts counts{};
    std::int64_t iterations = 0;
  };

  // Networks number first, first + 1, ..., all without the modes known now. Of modes that are the same, the
  // first.
  void run_networks(std::uint32_t first, std::uint32_t count) {
    const RunLimits limits = choose_limits(regions_, cells_);
    const std::int64_t most_draws = has_good_mode() ? limits.rival_draws : limits.draws;
    const std::int64_t draws = std::max<std::int64_t>(0, most_draws - answer_.counts.draws) / count;
    const std::vector<Pose2> T_map_mode = poses_of_modes();
    std::vector<Outcome> outcomes(count);
    const bool one_by_one = settings_.observe || settings_.measure_time;
    parallel_for(count, one_by_one ? 1 : query_.threads, [&](std::size_t i) {
      outcomes[i] = run_network(first + static_cast<std::uint32_t>(i), T_map_mode, draws);
    });
    for (const Outcome& outcome : outcomes) {
      answer_.counts.add(outcome.counts);
      answer_.iterations += outcome.iterations;
      const std::vector<Pose2> T_map_known = poses_of_modes();
      const bool room = answer_.modes.size() < settings_.most_modes;
      if (room && outcome.mode && !excluded(T_map_known).contains(outcome.mode->T_map_robot))
        answer_.modes.push_back(*outcome.mode);
    }
  }

  [[nodiscard]] Outcome run_network(std::uint32_t number, std::span<const Pose2> T_map_mode,
                                    std::int64_t draws) const {
    Network network({.levels = levels_,
                     .sampler = sampler_,
                     .start_levels = start_levels_,
                     .bands = bands_,
                     .rays = rays_},
                    excluded(T_map_mode),
                    {.cells = cells_,
                     .seed = query_.options.seed,
                     .run = number,
                     .threads = query_.threads,
                     .measure_time = settings_.measure_time});
    Outcome outcome;
    outcome.mode = until_equilibrium(network, number, draws, outcome.counts.step_ms);
    outcome.counts.add(network.counts());
    outcome.iterations = network.iterations();
    return outcome;
  }

  [[nodiscard]] std::vector<Pose2> poses_of_modes() const {
    std::vector<Pose2> T_map_mode;
    for (const DiffusionMode& mode : answer_.modes) T_map_mode.push_back(mode.T_map_robot);
    return T_map_mode;
  }
  [[nodiscard]] Excluded excluded(std::span<const Pose2> T_map_mode) const {
    return {.T_map_mode = T_map_mode,
            .reach = {.half_m = std::max(query_.options.distinct_translation_m, levels_.front().half_m),
                      .half_rad = std::max(query_.options.distinct_rotation_rad, levels_.front().half_rad)}};
  }

  [[nodiscard]] int most_agreeing() const {
    int most = 0;
    for (const DiffusionMode& mode : answer_.modes) most = std::max(most, mode.agreeing);
    return most;
  }
  [[nodiscard]] bool has_good_mode() const {
    return most_agreeing() >= good * static_cast<double>(bands_.size());
  }
  // Beside a good mode, several that are worse.
  [[nodiscard]] bool none_explains_as_well() const {
    const double least = as_well * most_agreeing();
    const auto worse = std::count_if(answer_.modes.begin(), answer_.modes.end(),
                                     [&](const DiffusionMode& mode) { return mode.agreeing < least; });
    return has_good_mode() && worse >= enough_worse;
  }

  std::optional<DiffusionMode> until_equilibrium(Network& network, std::uint32_t number, std::int64_t draws,
                                                 double& cluster_ms) const {
    const RunLimits limits = choose_limits(regions_, cells_);
    Equilibrium equilibrium({.cells = cells_});
    int saturated = 0;
    while (network.counts().draws < draws && network.iterations() < limits.iterations) {
      if (query_.out_of_time()) break;
      network.step();
      if (settings_.observe) settings_.observe(network, number);
      const double start_ms = settings_.measure_time ? thread_time_ms() : 0.0;
      const Cluster cluster = cluster_of(network, network.counts().focused);
      if (settings_.measure_time) cluster_ms += thread_time_ms() - start_ms;
      if (equilibrium.add(cluster.cells)) return mode_of(network, cluster);
      const bool most =
          static_cast<double>(network.counts().active) >= saturation * static_cast<double>(cells_);
      saturated = most ? saturated + 1 : 0;
      if (saturated >= most_saturated)
        return mode_of(network, cluster.cells >= 2 ? cluster
                                                   : largest_cluster(network.cells().mappings(),
                                                                     levels_.front(), Counted::active));
    }
    return std::nullopt;
  }

  [[nodiscard]] static Cluster cluster_of(const Network& network, std::int64_t focused) {
    return focused >= 2 ? largest_cluster(network.cells().mappings(), cluster_reach) : Cluster{};
  }

  [[nodiscard]] DiffusionMode mode_of(const Network& network, const Cluster& cluster) const {
    return {.T_map_robot = cluster.T_map_robot,
            .agreeing = rays_.count_agreeing(cluster.T_map_robot, levels_.size() - 1),
            .cells = static_cast<int>(cluster.cells),
            .iterations = static_cast<int>(network.iterations())};
  }

  const Query& query_;
  const DiffusionSettings& settings_;
  PoseSampler sampler_;
  std::vector<FocusLevel> levels_;
  std::vector<std::size_t> start_levels_;
  BeamBands bands_;
  TestRays rays_;
  double regions_;
  std::size_t cells_;
  DiffusionAnswer answer_;
};

}  // namespace

DiffusionAnswer find_modes_by_diffusion(const Query& query, const DiffusionSettings& settings) {
  return DiffusionSearch(query, settings).run();
}

}  // namespace landfall::internal
