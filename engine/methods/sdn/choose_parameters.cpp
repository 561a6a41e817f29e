#include "engine/methods/sdn/choose_parameters.hpp"

#include <algorithm>
#include <cmath>

#include "engine/methods/sdn/find_modes_by_diffusion.hpp"

namespace landfall::internal {
namespace {

constexpr FocusLevel default_top{.half_m = 0.5, .half_rad = 0.0872664626};  // 5 degrees

}  // namespace

double volume_of(const FocusLevel& level) {
  return 8.0 * level.half_m * level.half_m * level.half_rad;
}

std::vector<FocusLevel> make_levels(const PoseSampler& sampler, const DiffusionSettings& settings) {
  if (!settings.focused) return {finest_level};
  const FocusLevel top = settings.top.half_m > 0.0 ? settings.top : default_top;
  return make_focus_levels({.half_m = std::min(top.half_m, sampler.half_extent_m()),
                            .half_rad = std::min(top.half_rad, sampler.half_extent_rad())});
}

std::vector<std::size_t> start_levels(const PoseSampler& sampler, std::span<const FocusLevel> levels) {
  std::vector<std::size_t> start(sampler.components(), 0);
  for (std::size_t i = 0; i < start.size(); ++i)
    while (start[i] + 1 < levels.size() && levels[start[i] + 1].half_m >= sampler.half_extent_m(i))
      ++start[i];
  return start;
}

double map_noise_m(const PreparedState& map) {
  return map.is_plan() ? 0.0 : map.grid().resolution_m;
}

std::size_t choose_cells(double regions) {
  // Measured in rooms and workshops of 550 to 49,000 regions (bench/fsdn_cells.py).
  constexpr double cells_per_root = 1.4;
  constexpr double fewest = 48.0;  // fewer gain little, and their mean is rough
  constexpr double most = 4096.0;
  return static_cast<std::size_t>(std::clamp(cells_per_root * std::sqrt(regions), fewest, most));
}

RunLimits choose_limits(double regions, std::size_t cells) {
  constexpr double draws_per_region = 12.0;
  constexpr double rival_draws_per_region = 6.0;
  constexpr double iterations_per_draw = 10.0;
  constexpr double fewest_iterations = 200.0;
  const auto count = static_cast<double>(cells);
  const double first = 10.0 * count;  // the initial draws are but a part of a short search
  return {.draws = static_cast<std::int64_t>(draws_per_region * regions + first),
          .rival_draws = static_cast<std::int64_t>(rival_draws_per_region * regions + first),
          .iterations = static_cast<std::uint32_t>(
              std::min(4e9, fewest_iterations + iterations_per_draw * draws_per_region * regions / count))};
}

}  // namespace landfall::internal
