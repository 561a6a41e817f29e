// What faces a robot that turns on the spot: a surface met head on, or an edge, keeps its distance as long as
// it is in the cone, so that it shows as a plateau of readings, as wide as the cone.
#pragma once

#include <span>
#include <vector>

#include "engine/scans/turn_readings.hpp"

namespace landfall::internal {

// Where a surface faces the robot, or an edge is.
struct FacingPoint {
  double bearing_rad = 0.0;
  double distance_m = 0.0;  // from the turn's centre
};

struct TurnPlateaus {
  std::vector<FacingPoint> points{};
  std::vector<bool> taken{};  // readings that belong to a plateau
};

struct PlateauRule {
  double equal_sigmas = 3.0;    // of one reading's noise, off the plateau's mean
  double slack_m = 0.0;         // and beside it, so much
  double turn_step_rad = 0.0;   // neighbours in a plateau are no farther apart
  double least_density = 0.85;  // of the readings between its ends, so many belong to it
};

// `readings` by bearing. A plateau, grown from the shortest reading outwards, is as wide as half a cone at
// least, no reading between its ends is shorter (but those of nearer plateaus), and few are longer. At an end
// beyond which readings are longer, what faces the robot leaves the cone: it lies a half-angle inside. Two
// such ends mean two facing points, or, where they agree, one in the middle. An end beyond which readings are
// shorter says nothing; a plateau with two of these is dropped.
TurnPlateaus find_plateaus(std::span<const TurnReading> readings, const PlateauRule& rule);

}  // namespace landfall::internal
