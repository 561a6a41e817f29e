// One scan beside another, without a map: the conventional methods that mapping is compared to.
#pragma once

#include <cstdint>
#include <numbers>

#include "landfall/scan.hpp"

namespace landfall {

enum class ScanMatcher : std::uint8_t {
  icp,                // iterative closest point, point to point (Besl & McKay 1992)
  icp_point_to_line,  // the same along the earlier scan's normals (Chen & Medioni 1992)
  angle_histogram,    // cross-correlated histograms of angles, then of x and y (Weiss et al. 1994)
};

struct ScanMatchOptions {
  ScanMatcher matcher = ScanMatcher::icp;
  double range_min_m = 0.3;  // nearer echoes are left out
  double reach_m = 0.5;      // icp: points farther apart are not matched; histograms: the largest shift
  double reach_rad = 50.0 * std::numbers::pi / 180.0;  // histograms: the largest turn
  int iterations = 50;                                 // icp: at most so many
  double bin_m = 0.02;                                 // of histograms
  double bin_rad = 0.5 * std::numbers::pi / 180.0;
};

// T_before_after: where the later scan was taken, in the earlier one's robot frame. From a start near it;
// where a scan has too few points, the start. Throws Error{invalid_argument}: a scan that does not validate,
// a start that is not finite, an option out of range.
Pose2 match_scans(const Scan& before, const Scan& after, const Pose2& T_before_start = {},
                  const ScanMatchOptions& options = {});

}  // namespace landfall
