// Which way of casting rays is the fastest for a map and a pattern of rays. A function of these alone, so
// that answers do not depend on what a clock said.
#pragma once

#include <cstdint>
#include <string_view>

namespace landfall::raycast {

enum class Way {
  embree,         // packets of rays against walls in a tree of boxes
  distance_walk,  // from one free square of a grid to the next
  segment_tree    // the nearest wall point in a cone
};
std::string_view name(Way way);

enum class Pattern { fan, single_rays, cones };

struct MapShape {
  std::int64_t grid_cells = 0;  // 0: a plan, which is more exact than any grid of it
};

Way choose_way(const MapShape& map, Pattern pattern);

}  // namespace landfall::raycast
