// Relative poses of a few consecutive scans, polished by matching each scan to those before it.
#pragma once

#include <span>
#include <vector>

#include "landfall/scan.hpp"

namespace landfall {

// One sigma of odometry's error between two consecutive scans: wide enough for a robot that slips. Where
// odometry agrees with the scans, align() finds it better than stated and trusts it more.
struct OdometryNoise {
  double translation_m = 0.05;          // constant part
  double translation_relative = 0.10;   // per metre driven
  double translation_per_rad_m = 0.10;  // per radian turned: slip, or a sensor off the centre of turning
  double rotation_rad = 0.10;           // constant part
  double rotation_per_m_rad = 0.05;     // per metre driven
  double rotation_relative = 0.10;      // per radian turned
};

struct AlignOptions {
  OdometryNoise odometry;
  double resolution_m = 0.1;  // of the grids that scans are searched on: 0.01 to 1; the poses are finer
  int threads = 0;
};

// T_reference_robot[i]: where scan i was taken in the robot frame of scan `reference`. Each scan is searched
// beside the one before it, within odometry's uncertainty (three sigma); the sequence that fits best as a
// whole is refined, all scans at once; odometry counts for as much as it proves good in this window. Where
// scans say nothing (no echoes, along a corridor), odometry's step stays.
// Throws Error{invalid_argument}: no scans, an option out of range, a scan that does not validate or has no
// odometry.
std::vector<Pose2> align(std::span<const Scan> scans, std::size_t reference,
                         const AlignOptions& options = {});

// How good align()'s relative poses are, most of the time: for merge().
inline constexpr RelativePoseNoise aligned_noise{.translation_m = 0.03, .rotation_rad = 0.008};

}  // namespace landfall
