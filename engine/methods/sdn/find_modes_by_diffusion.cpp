#include "engine/methods/sdn/find_modes_by_diffusion.hpp"

#include <algorithm>
#include <cmath>

#include "engine/methods/sdn/choose_parameters.hpp"
#include "engine/methods/sdn/cluster.hpp"
#include "engine/methods/sdn/equilibrium.hpp"

namespace landfall::internal {
namespace {

// A cluster is as wide as the finest level's tests let it be.
constexpr FocusLevel cluster_reach{.half_m = 0.1, .half_rad = 0.06};
// A mode that explains less than this part of the best one does not explain as well.
constexpr double as_well = 0.85;

// The networks of one query.
class DiffusionSearch {
 public:
  DiffusionSearch(const Query& query, const DiffusionSettings& settings)
      : query_(query),
        settings_(settings),
        sampler_(query.lattice, query.domain),
        levels_(make_levels(sampler_, settings)),
        bands_(query.scan, levels_,
               {.region_share = settings.region_share, .map_noise_m = map_noise_m(query.map)}),
        rays_(query.map, query.scan, bands_),
        regions_(std::max(1.0, sampler_.volume() / volume_of(levels_.front()))),
        cells_(settings.cells > 0 ? settings.cells : choose_cells(regions_)) {}

  DiffusionAnswer run() {
    answer_ = {.levels = levels_, .regions = regions_, .cells = cells_, .beams = static_cast<int>(bands_.size())};
    const auto most_modes = static_cast<std::size_t>(std::max(1, query_.options.max_hypotheses));
    int most_agreeing = 0;
    for (std::uint32_t number = 0; answer_.modes.size() < most_modes; ++number) {
      const std::optional<DiffusionMode> mode = run_network(number);
      if (!mode) break;
      answer_.modes.push_back(*mode);
      if (mode->agreeing < as_well * most_agreeing) break;
      most_agreeing = std::max(most_agreeing, mode->agreeing);
    }
    return std::move(answer_);
  }

 private:
  std::optional<DiffusionMode> run_network(std::uint32_t number) {
    std::vector<Pose2> T_map_mode;
    for (const DiffusionMode& mode : answer_.modes) T_map_mode.push_back(mode.T_map_robot);
    const Excluded excluded{
        .T_map_mode = T_map_mode,
        .reach = {.half_m = std::max(query_.options.distinct_translation_m, levels_.front().half_m),
                  .half_rad = std::max(query_.options.distinct_rotation_rad, levels_.front().half_rad)}};
    Network network({.levels = levels_, .sampler = sampler_, .bands = bands_, .rays = rays_}, excluded,
                    {.cells = cells_,
                     .seed = query_.options.seed,
                     .run = number,
                     .threads = query_.threads,
                     .measure_casting = settings_.measure_casting});
    std::optional<DiffusionMode> mode = until_equilibrium(network, number);
    answer_.counts.add(network.counts());
    answer_.iterations += network.iterations();
    return mode;
  }

  std::optional<DiffusionMode> until_equilibrium(Network& network, std::uint32_t number) {
    const RunLimits limits = choose_limits(regions_, cells_, number > 0);
    Equilibrium equilibrium({.cells = cells_});
    while (network.counts().draws < limits.draws && network.iterations() < limits.iterations) {
      if (query_.out_of_time()) break;
      network.step();
      if (settings_.observe) settings_.observe(network, number);
      const Cluster cluster = network.counts().focused >= 2
                                  ? largest_cluster(network.cells().mappings(), cluster_reach)
                                  : Cluster{};
      if (!equilibrium.add(cluster.cells)) continue;
      return DiffusionMode{.T_map_robot = cluster.T_map_robot,
                           .agreeing = rays_.count_agreeing(cluster.T_map_robot, levels_.size() - 1),
                           .cells = static_cast<int>(cluster.cells),
                           .iterations = static_cast<int>(network.iterations())};
    }
    return std::nullopt;
  }

  const Query& query_;
  const DiffusionSettings& settings_;
  PoseSampler sampler_;
  std::vector<FocusLevel> levels_;
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
