#include "engine/rank/neighbourhoods.hpp"

#include <algorithm>
#include <cstdint>
#include <numbers>
#include <unordered_map>

#include "kernels/score_block.hpp"

namespace landfall::internal {

std::vector<Neighbourhood> neighbourhoods(const Query& query, const std::vector<Candidate>& candidates,
                                          std::size_t most, std::size_t most_members) {
  const Lattice& lattice = query.lattice;
  const int side = kernels::block_cells * lattice.step_cells;
  constexpr double all_rad = 4.0 * std::numbers::pi;  // no headings are distinct
  const double width_rad = std::min(query.options.distinct_rotation_rad, all_rad);
  const int headings = std::max(1, static_cast<int>(width_rad / lattice.heading_step_rad()));
  std::vector<Neighbourhood> places;
  std::unordered_map<std::uint64_t, std::size_t> place_at;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    const LatticePose& pose = candidates[i].pose;
    const auto key = (static_cast<std::uint64_t>(pose.heading / headings) << 40U) +
                     (static_cast<std::uint64_t>(pose.row / side) << 20U) +
                     static_cast<std::uint64_t>(pose.col / side);
    const auto known = place_at.find(key);
    if (known != place_at.end()) {
      Neighbourhood& place = places[known->second];
      if (place.size() < most_members) place.push_back(i);
    } else if (places.size() < most) {
      place_at.emplace(key, places.size());
      places.push_back({i});
    }
  }
  return places;
}

}  // namespace landfall::internal
