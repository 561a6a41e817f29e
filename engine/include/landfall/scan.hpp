// What a sensor saw at one time; several scans from known relative poses are one composite scan.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "landfall/sensor.hpp"

namespace landfall {

struct Scan {
  std::shared_ptr<const Sensor> sensor{};
  std::vector<float> ranges_m{};  // one per beam; NaN: invalid; >= the beam's range_max_m: nothing hit
  double stamp_s = 0.0;
  std::optional<Pose2> T_odom_robot{};  // odometry at that time
  std::optional<Pose2> T_map_robot{};   // a pose recorded in the log (corrected log, localizer): never
                                        // used by search; the truth for mapping from known poses
};

enum class Reading { invalid, echo, no_echo };
// NaN, negative, zero or below range_min_m: invalid. At or above range_max_m, +inf: no_echo.
Reading classify(const Beam& beam, float range_m);
// Number of beams that are not invalid.
int count_valid(const Scan& scan);
int count_echoes(const Scan& scan);

// Throws Error{invalid_argument}: no sensor, a sensor that validate() refuses, a number of ranges
// other than the sensor's beams, a stamp or pose that is not finite.
void validate(const Scan& scan);

// One scan with the beams of all of them, seen from scan `reference`'s robot frame and under its
// stamp. T_common_robot[i] is where scan i was taken, in any frame common to all (such as odom).
// Noise: the largest of the sensors'. Throws Error{invalid_argument} where sizes differ or are zero.
Scan merge(std::span<const Scan> scans, std::span<const Pose2> T_common_robot, std::size_t reference);
// The same from the scans' own odometry, seen from the last scan. Throws where one has none.
Scan merge(std::span<const Scan> scans);

}  // namespace landfall
