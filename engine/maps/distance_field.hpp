// Distances to the nearest occupied cell, and the likelihood field made of them.
#pragma once

#include <cstdint>
#include <vector>

#include "landfall/grid_map.hpp"

namespace landfall::internal {

// Exact squared distances between cell centres, in cells; kernels::far_squared where nothing is marked.
// `marked` says which cells are at distance 0, one byte a cell.
std::vector<std::int32_t> squared_distances(const std::vector<std::uint8_t>& marked, int width, int height);

// 255 exp(-d^2 / (2 sigma^2)), rounded (Thrun et al., Probabilistic Robotics, 6.4).
// Unknown cells have at least `unknown_value`.
std::vector<std::uint8_t> likelihood_field(const GridMap& map, double sigma_m, std::uint8_t unknown_value);

}  // namespace landfall::internal
