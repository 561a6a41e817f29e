// Bounds of equation (1) over blocks of poses: what may be left out without a look.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/methods/grid/level.hpp"

namespace landfall::internal {

struct BoundedPoses {
  std::vector<SharedMask> mask_of_heading;  // the level's poses whose block may score enough; null: none
  std::int64_t bounds_computed = 0;
  bool cut_short = false;  // the time was up
};

// The level's poses but for those whose blocks, of 4 x 4 cells, score less than `lowest` at any rate: in a
// block a cell that speaks for an obstacle meets at best the largest value of the global grid in a window as
// large as the block, one that speaks for free space the smallest. Nothing is left out where the tables of
// these would be too large.
BoundedPoses poses_within_bounds(const GridLevel& level, std::int32_t lowest);

}  // namespace landfall::internal
