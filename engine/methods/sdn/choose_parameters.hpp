// The networks' parameters, from the size of what they search (Beattie & Bishop 4.2, "further research").
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/maps/prepared_state.hpp"
#include "engine/methods/sdn/focus_levels.hpp"
#include "engine/priors/pose_sampler.hpp"

namespace landfall::internal {

struct DiffusionSettings;

// Of a level's region, in square metres times radians.
double volume_of(const FocusLevel& level);

// The pyramid over a prior: its top as wide as the settings say, or as tests are the fewest with, but no
// wider than the prior itself. One level, the finest, where the network is not focused.
std::vector<FocusLevel> make_levels(const PoseSampler& sampler, const DiffusionSettings& settings);

// 3.1, beacons: per component of the prior, where cells that draw from it start: the finest level whose
// region covers the component's positions, headings drawn from the component. A component that no region
// covers is drawn from at the top, as the parts of a region that does would be: uniformly.
std::vector<std::size_t> start_levels(const PoseSampler& sampler, std::span<const FocusLevel> levels);

// By how much a map's walls may be off: a plan's are exact, a grid's are good to a cell.
double map_noise_m(const PreparedState& map);

// The number of cells. Searching costs so many tests a region, whatever the cells; gathering and focusing so
// many a cell; and the fewer cells there are, the more of them a false place holds, in proportion to
// regions / cells. The sum a regions + b cells + c regions / cells is least at cells in proportion to the
// root of the regions, and flat around it: what other numbers take is measured in bench/fsdn_cells.py.
std::size_t choose_cells(double regions);

// How long the networks of a scan may go on: so many draws that a region which holds the robot is hit, but
// for one time in e to the draws per region. Fewer where a mode is known that explains the scan well: rivals.
// And iterations, should hardly any cell draw.
struct RunLimits {
  std::int64_t draws = 0;
  std::int64_t rival_draws = 0;
  std::uint32_t iterations = 0;  // of one network
};
RunLimits choose_limits(double regions, std::size_t cells);

}  // namespace landfall::internal
