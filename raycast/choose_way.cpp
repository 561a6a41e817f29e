#include "raycast/choose_way.hpp"

#include "raycast/free_squares.hpp"

namespace landfall::raycast {

std::string_view name(Way way) {
  switch (way) {
    case Way::embree:
      return "embree";
    case Way::distance_walk:
      return "distance_walk";
    case Way::segment_tree:
      return "segment_tree";
  }
  return "";
}

Way choose_way(const MapShape& map) {
  const bool is_grid = map.width_cells > 0 && map.height_cells > 0;
  return is_grid && FreeSquareTable::can_hold(map.width_cells, map.height_cells) ? Way::distance_walk
                                                                                 : Way::embree;
}

}  // namespace landfall::raycast
