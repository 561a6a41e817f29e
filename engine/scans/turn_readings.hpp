// The readings of a turn on the spot, of all its sonars together, ordered by where they look.
#pragma once

#include <span>
#include <vector>

#include "landfall/scan.hpp"

namespace landfall::internal {

// One reading, in the frame of the turn's first scan.
struct TurnReading {
  double bearing_rad = 0.0;  // of its beam, in [0, 2 pi)
  Point2 mount{};            // where the beam begins
  double range_m = 0.0;      // infinite: no echo
  // From the turn's centre to a surface that the beam meets head on: to this the mount does not matter.
  double foot_m = 0.0;
  double noise_m = 0.0;  // one sigma
  double half_angle_rad = 0.0;
};

// Throws Error{invalid_argument}: a scan that does not validate, or scans of different sensors.
void check_turn(std::span<const Scan> turn);

// Scan i of n was taken at heading i 2 pi / n of the first one's robot frame. Invalid readings are passed
// over.
std::vector<TurnReading> interleaved_readings(std::span<const Scan> turn);

// By how much one surface's foot_m differs at most between the beams whose cones hold its foot.
double foot_slack_m(const Sensor& sensor);

// An angle in [0, 2 pi).
double positive_angle(double angle_rad);

}  // namespace landfall::internal
