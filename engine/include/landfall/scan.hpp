// What a sensor saw at one time; several scans from known relative poses are one composite scan.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "landfall/sensor.hpp"

namespace landfall {

// How far a composite's relative poses may be off: one sigma between consecutive scans.
struct RelativePoseNoise {
  double translation_m = 0.0;
  double rotation_rad = 0.0;
};

// The scans of a composite whose relative poses may be off: its beams are theirs, one scan after the other.
struct ScanParts {
  std::vector<std::size_t> beams{};        // how many of each
  std::vector<Pose2> T_reference_robot{};  // where each was taken, in the composite's robot frame
  std::size_t reference = 0;               // the scan whose robot frame that is
  RelativePoseNoise noise{};
};

struct Scan {
  std::shared_ptr<const Sensor> sensor{};
  std::vector<float> ranges_m{};  // one per beam; NaN: invalid; >= the beam's range_max_m: nothing hit
  double stamp_s = 0.0;
  std::optional<Pose2> T_odom_robot{};  // odometry at that time
  std::optional<Pose2> T_map_robot{};   // a pose recorded in the log (corrected log, localizer): never
                                        // used by search; the truth for mapping from known poses
  std::optional<ScanParts> parts{};     // search fits each of them to the map; none: beams are as they are
  // What this scan was condensed from (merge_turn_minima), in the same robot frame; none: it is what was
  // measured. search proposes poses by the scan's own echoes and judges them by these as well. Logs do not
  // keep it.
  std::shared_ptr<const Scan> measured{};
};

enum class Reading { invalid, echo, no_echo };
// NaN, negative, zero or below range_min_m: invalid. At or above range_max_m, +inf: no_echo.
Reading classify(const Beam& beam, float range_m);
// Number of beams that are not invalid.
int count_valid(const Scan& scan);
int count_echoes(const Scan& scan);

// Throws Error{invalid_argument}: no sensor, a sensor that validate() refuses, a number of ranges
// other than the sensor's beams, a stamp or pose that is not finite, parts with other beams or poses, a
// measured scan that does not validate, has parts or was condensed itself, or stands beside parts.
void validate(const Scan& scan);

// One scan with the beams of all of them, seen from scan `reference`'s robot frame and under its
// stamp. T_common_robot[i] is where scan i was taken, in any frame common to all (such as odom).
// Sensor noise: the largest of the sensors'. What scans were condensed from is left behind. Relative poses
// are taken as given, unless `noise` says how far they may be off: then each hypothesis of search has every
// scan where it fits the map best within that, and `explained` is of the scans there; score and covariance
// are of the composite as given. Throws Error{invalid_argument} where sizes differ or are zero, and for noise
// that is negative or not finite.
Scan merge(std::span<const Scan> scans, std::span<const Pose2> T_common_robot, std::size_t reference,
           const RelativePoseNoise& noise = {});
// Where odometry had the robot at each scan. Throws Error{invalid_argument} where one has none.
std::vector<Pose2> odometry_of(std::span<const Scan> scans);
// merge() from the scans' own odometry, seen from the last scan.
Scan merge(std::span<const Scan> scans);

}  // namespace landfall
