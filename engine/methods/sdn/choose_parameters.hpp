// The networks' parameters, from the size of what they search (Beattie & Bishop 4.2, "further research").
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/methods/sdn/focus_levels.hpp"
#include "engine/methods/sdn/pose_sampler.hpp"
#include "engine/prepared_state.hpp"

namespace landfall::internal {

struct DiffusionSettings;

// Of a level's region, in square metres times radians.
double volume_of(const FocusLevel& level);

// The pyramid over a prior: its top as wide as the settings say, or as tests are the fewest with, but no
// wider than the prior itself. One level, the finest, where the network is not focused.
std::vector<FocusLevel> make_levels(const PoseSampler& sampler, const DiffusionSettings& settings);

// By how much a map's walls may be off: a plan's are exact, a grid's are good to a cell.
double map_noise_m(const PreparedState& map);

// The number of cells that makes the expected time least; see choose_parameters.cpp for the model.
std::size_t choose_cells(double regions);

struct RunLimits {
  std::int64_t draws = 0;
  std::uint32_t iterations = 0;
};
// How long the networks of a scan may go on: as many draws as miss a region that holds the robot once in 50
// times, and iterations of a network in which hardly any cell draws.
RunLimits choose_limits(double regions, std::size_t cells);

}  // namespace landfall::internal
