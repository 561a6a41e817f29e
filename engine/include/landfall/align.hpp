// Relative poses of a few consecutive scans, polished by matching each scan to those before it.
#pragma once

#include <span>
#include <vector>

#include "landfall/scan.hpp"

namespace landfall {

// One sigma of odometry's error between two consecutive scans.
struct OdometryNoise {
  double translation_m = 0.05;           // constant part
  double translation_relative = 0.10;    // per metre driven
  double rotation_rad = 0.05;            // constant part
  double rotation_per_m_rad = 0.05;      // per metre driven
  double rotation_relative = 0.10;       // per radian turned
};

struct AlignOptions {
  OdometryNoise odometry;
  double resolution_m = 0.05;  // of the growing composite's field
  int threads = 0;
};

// T_reference_robot[i]: where scan i was taken in the robot frame of scan `reference`. Each scan is
// matched to the growing composite of its neighbours, within odometry's uncertainty (three sigma);
// where the match is no better than odometry's guess, that is kept.
// Throws Error{invalid_argument}: no scans, a scan that does not validate or has no odometry.
std::vector<Pose2> align(std::span<const Scan> scans, std::size_t reference, const AlignOptions& options = {});

}  // namespace landfall
