// What MRPT (mrpt.org) makes of a map: its likelihood field and its simulator of laser scans. Poses are in
// the grid's frame.
#pragma once

#include <memory>
#include <span>

#include "landfall/prepared_map.hpp"

namespace landfall::bench {

class MrptMap {
 public:
  explicit MrptMap(const PreparedMap& map);
  ~MrptMap();
  MrptMap(MrptMap&&) noexcept;
  MrptMap& operator=(MrptMap&&) noexcept;

  // The end points that mean_likelihood is of, in the robot's frame.
  void set_points(std::span<const double> x_m, std::span<const double> y_m);
  // exp(-d^2 / (2 sigma^2)), the mean over the points: COccupancyGridMap2D::computeLikelihoodField_Thrun with
  // its cache of cells. Log of it, as MRPT has it.
  [[nodiscard]] double log_mean_likelihood(const Pose2& T_grid_robot) const;
  // COccupancyGridMap2D::laserScanSimulator: beams evenly spaced from -aperture / 2 to +aperture / 2.
  // +inf: nothing hit.
  void simulate_scan(const Pose2& T_grid_sensor, double aperture_rad, double range_max_m,
                     std::span<float> ranges_m) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace landfall::bench
