// The largest group of cells that point to the same place.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "engine/methods/sdn/cells.hpp"

namespace landfall::internal {

struct Cluster {
  std::size_t cells = 0;
  Pose2 T_map_robot{};  // their mean, of headings the circular one
};

enum class Counted : std::uint8_t {
  focused,  // 3.4: cells within tolerance at the finest level
  active
};

// Among the mappings counted; those within `reach` of their mean are one group.
Cluster largest_cluster(std::span<const Mapping> mappings, const FocusLevel& reach,
                        Counted counted = Counted::focused);

}  // namespace landfall::internal
