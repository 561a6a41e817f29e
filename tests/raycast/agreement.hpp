// When a range in floats agrees with an oracle in double.
//
// Rule for rays that graze: the scene computes in floats, so it may see a ray up to `grazing_shift_m`
// beside where it is. Its range must lie between those of the oracle's rays shifted to either side by that
// much; all but a few rays must agree with the oracle's ray itself.
#pragma once

#include <algorithm>
#include <cmath>

namespace landfall::testing {

inline constexpr double range_tolerance_m = 1e-3;
inline constexpr double grazing_shift_m = 2e-5;

struct Agreement {
  int rays = 0;
  int grazing = 0;  // beyond the tolerance, yet between the shifted rays
  int wrong = 0;

  // oracle(shift_m): the range of the ray shifted to its left. Beyond range_max_m all ranges are one.
  template <typename Oracle>
  void add(double range_m, double range_max_m, const Oracle& oracle) {
    const auto expected_m = [&](double shift_m) { return std::min(oracle(shift_m), range_max_m); };
    ++rays;
    range_m = std::min(range_m, range_max_m);
    const double here_m = expected_m(0.0);
    if (std::abs(range_m - here_m) <= range_tolerance_m) return;
    const auto [low_m, high_m] =
        std::minmax({here_m, expected_m(grazing_shift_m), expected_m(-grazing_shift_m)});
    const bool between = range_m >= low_m - range_tolerance_m && range_m <= high_m + range_tolerance_m;
    between ? ++grazing : ++wrong;
  }

  [[nodiscard]] bool holds() const { return wrong == 0 && grazing <= rays / 1000; }
};

}  // namespace landfall::testing
