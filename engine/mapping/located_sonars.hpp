// What every map from sonars asks of its scans.
#pragma once

#include <span>
#include <string>

#include "landfall/grid_map.hpp"
#include "landfall/scan.hpp"

namespace landfall::internal {

// Throws Error{invalid_argument} that names the scan or beam: none, no T_map_robot, a half-angle outside
// (0, pi / 2).
void validate_located_sonars(std::span<const Scan> scans, const std::string& what);

// All unknown; covers the poses and the end points of all echoes. Throws as make_grid.
GridMap grid_around(std::span<const Scan> scans, double resolution_m, double margin_m,
                    const std::string& what);

// Throws Error{invalid_argument} unless it holds.
void require_option(bool holds, const std::string& what, const char* field, double value,
                    const char* expected);

}  // namespace landfall::internal
