// Neighbouring headings that are bounded together.
#pragma once

#include <algorithm>

#include "engine/priors/lattice.hpp"
#include "engine/scans/end_points.hpp"

namespace landfall::internal {

struct HeadingGroups {
  int headings = 0;  // of the lattice
  int per_group = 1;

  [[nodiscard]] int count() const { return (headings + per_group - 1) / per_group; }
  [[nodiscard]] int first(int group) const { return group * per_group; }
  [[nodiscard]] int last(int group) const { return std::min(headings, (group + 1) * per_group); }
  // Two of these in one.
  [[nodiscard]] HeadingGroups doubled() const { return {.headings = headings, .per_group = 2 * per_group}; }
};

// Groups so wide that a typical end point moves by about half a block over one.
HeadingGroups choose_groups(const EndPoints& points, const Lattice& lattice);

}  // namespace landfall::internal
