// The largest group of cells that point to the same place.
#pragma once

#include <cstddef>
#include <span>

#include "engine/methods/sdn/cells.hpp"

namespace landfall::internal {

struct Cluster {
  std::size_t cells = 0;
  Pose2 T_map_robot{};  // their mean, of headings the circular one
};

// Among the focused mappings; those within `reach` of their mean are one group. A group that several places
// share at their border is found where most of it is.
Cluster largest_cluster(std::span<const Mapping> mappings, const FocusLevel& reach);

}  // namespace landfall::internal
