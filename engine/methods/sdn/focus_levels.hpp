// The pyramid of the focused network: regions of poses, from coarse to fine.
//
// Beattie & Bishop, section 3 and figure 3.
#pragma once

#include <vector>

namespace landfall::internal {

// A box of poses around a centre: half widths.
struct FocusLevel {
  double half_m = 0.0;
  double half_rad = 0.0;
};

// The resolution that the paper's wheelchair needs.
inline constexpr FocusLevel finest_level{.half_m = 0.01, .half_rad = 0.0174532925199433};

// Top first, finest_level last; each level's half_m is at most half of the one above. A top that is no
// larger than the finest is one level.
std::vector<FocusLevel> make_focus_levels(FocusLevel top);

}  // namespace landfall::internal
