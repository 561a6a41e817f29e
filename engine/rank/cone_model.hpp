// How likely a sonar's readings are where the map gives others, for readings of which many are too long.
//
// Espino et al., section 3.2: sound that meets a surface at a slant is reflected away, and what comes back
// came a longer way; a reading is never much too short. A mixture per reading, as the beam model's
// (beam_model.hpp), but longer ones are as common as those that are right, and as likely anywhere beyond the
// nearest wall of the cone. In a map of cells the wall is anywhere within the cell that the cone meets.
#pragma once

#include <vector>

#include "engine/maps/prepared_state.hpp"
#include "landfall/scan.hpp"
#include "raycast/values.hpp"

namespace landfall::internal {

class ConeModel {
 public:
  // map outlives this.
  ConeModel(const PreparedState& map, const Scan& readings);

  // Natural logarithm. Readings beyond the twentieth add nothing: neighbours err together.
  [[nodiscard]] double log_likelihood(const Pose2& T_map_robot) const;
  [[nodiscard]] std::size_t readings() const { return readings_.size(); }

 private:
  struct Reading {
    double range_m;
    double range_max_m;
    bool echo;
  };
  [[nodiscard]] double likelihood(const Reading& reading, double nearest_m) const;

  const PreparedState& map_;
  double wall_depth_m_;  // a cell; 0 where the map's walls are exact
  double range_noise_m_;
  double range_noise_relative_;
  std::vector<Reading> readings_;
  std::vector<raycast::Beam> beams_;
};

}  // namespace landfall::internal
