// How well two scans agree where they look at the same place.
#pragma once

#include <cstddef>

#include "engine/align/scan_view.hpp"

namespace landfall::internal {

// Mean over the points of both scans, each as the other sees it: 1 on a surface that faces the same way, 0
// in seen free space, in between where nothing was seen.
double overlap_share(const ScanView& a, const ScanView& b, const Pose2& T_a_b);

// Nats for a share of 1. Points are not independent (neighbours stand on one wall, and what differs, differs
// for all of them), so that a scan's evidence grows with the fourth root of its points: 47 for 180.
double overlap_nats(std::size_t points);
double overlap_nats(const ScanView& a, const ScanView& b);

}  // namespace landfall::internal
