#include "engine/methods/sdn/focus_levels.hpp"

#include <algorithm>
#include <cmath>

namespace landfall::internal {

std::vector<FocusLevel> make_focus_levels(FocusLevel top) {
  top.half_m = std::max(top.half_m, finest_level.half_m);
  top.half_rad = std::max(top.half_rad, finest_level.half_rad);
  const double ratio_m = top.half_m / finest_level.half_m;
  const double ratio_rad = top.half_rad / finest_level.half_rad;
  const int steps = static_cast<int>(std::ceil(std::log2(std::max(ratio_m, ratio_rad)) - 1e-9));
  std::vector<FocusLevel> levels{top};
  for (int i = 1; i <= steps; ++i) {
    const double share = static_cast<double>(i) / steps;
    levels.push_back({.half_m = top.half_m * std::pow(ratio_m, -share),
                      .half_rad = top.half_rad * std::pow(ratio_rad, -share)});
  }
  return levels;
}

}  // namespace landfall::internal
