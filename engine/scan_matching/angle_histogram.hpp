// Two scans by cross-correlated histograms (Weiss, Wetzler & von Puttkamer 1994, Keeping Track of Position
// and Orientation of Moving Indoor Systems by Correlation of Range-Finder Scans): of the angles of the lines
// between neighbouring echoes, which gives the turn; then, both scans turned so that their most frequent
// angle lies along x, of x and of y, which gives the shift. The answer is a whole number of bins.
//
// What the paper leaves open: a line joins echoes that lie least_line_m apart or a little more, for between
// closer ones noise decides the angle; each counts with its length.
#pragma once

#include <span>

#include "landfall/pose2.hpp"

namespace landfall::internal {

struct HistogramOptions {
  double reach_m = 0.5;    // the largest shift, along either axis
  double reach_rad = 0.9;  // the largest turn
  double bin_m = 0.02;
  double bin_rad = 0.0087;
};

// End points in the order of the beams, each in its scan's frame. T_before_after near the start, or the start
// where either has too few points.
Pose2 match_histograms(std::span<const Point2> before, std::span<const Point2> after,
                       const Pose2& T_before_start, const HistogramOptions& options);

}  // namespace landfall::internal
