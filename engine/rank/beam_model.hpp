// How likely a scan's ranges are where the map gives others: the beam model, a mixture per reading.
//
// Thrun, Burgard & Fox 2005, Probabilistic Robotics, section 6.3: a hit with the range's noise, a reading
// that is too short (something stood there, crosstalk), one that is too long (a second reflection, a hole in
// the map), or anything. Changed: the nearest wall in a cone is its range; the hit is as wide as the sensor's
// noise and what poses between those that are compared may differ by; and how good map and readings are is
// not known, but the same for all beams of a scan: they are as stated, rough, or poor, and the likelihood is
// the sum over these.
#pragma once

#include <span>
#include <vector>

#include "landfall/grid_map.hpp"
#include "landfall/scan.hpp"
#include "raycast/values.hpp"

namespace landfall::internal {

// What lies between the poses that are compared: half a step, uniform, to either side.
struct PoseSpacing {
  double translation_m = 0.0;
  double rotation_rad = 0.0;
};

class BeamModel {
 public:
  BeamModel(const GridMap& map, const Scan& scan);

  // The beams with a reading, to be cast; simulated ranges are in their order, +inf where nothing is hit.
  [[nodiscard]] const std::vector<raycast::Beam>& beams() const { return beams_; }

  // Natural logarithm. An echo from an unknown cell, with nothing before it, is as likely as elsewhere. Beams
  // beyond the twentieth add nothing: neighbours err together.
  [[nodiscard]] double log_likelihood(const Pose2& T_map_robot, std::span<const float> simulated_m,
                                      const PoseSpacing& spacing) const;

  // Of the same readings from a place that is not on the map: echoes lie anywhere within twice their mean.
  [[nodiscard]] double log_likelihood_elsewhere() const;

 private:
  struct Reading {
    double range_m;
    double range_max_m;
    bool echo;
    Point2 end_robot;  // of the echo, on the beam's axis
  };
  struct Quality;
  static const Quality qualities[3];

  [[nodiscard]] double likelihood(const Reading& reading, double simulated_m, const PoseSpacing& spacing,
                                  const Quality& quality) const;
  // Of each reading, whether its echo comes from an unknown cell.
  [[nodiscard]] std::vector<bool> from_unknown(const Pose2& T_map_robot) const;
  [[nodiscard]] double weight_of_each() const;

  const GridMap& map_;
  Pose2 T_grid_map_;
  double spread_m_ = 1.0;  // of echoes elsewhere
  double range_noise_m_;
  double range_noise_relative_;
  std::vector<Reading> readings_;
  std::vector<raycast::Beam> beams_;
};

}  // namespace landfall::internal
