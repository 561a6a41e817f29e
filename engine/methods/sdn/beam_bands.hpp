// The test of the networks: which simulated ranges a beam allows, at each focus level.
//
// Beattie & Bishop 3.2: "the tolerance value that is used for comparison of ranges depends upon the level of
// focusing". Here it is derived: a cell stands for a region of poses (a box of half_m and half_rad around
// its mapping), and a beam's band holds the ranges that it would measure from the poses of that region. What
// a turn by half_rad or a step of half_m aside does to a beam, the scan itself shows: it then sees what its
// neighbours see now. So the band reaches from the least to the largest range of the beams within the angle
//     region_share * (half_rad + atan(half_m / range)),
// and half_m * region_share and the noise beyond both. Beams without neighbours near enough are taken to
// look at walls at 45 degrees.
//
// A range out of its band is evidence of two weights (ours): something that the map lacks may stand before a
// wall, but no beam passes through one.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/methods/sdn/focus_levels.hpp"
#include "landfall/scan.hpp"

namespace landfall::internal {

// Bands for all of a region are passed by chance too often, which costs more tests than the poses near a
// region's border that bands for this share of its widths miss (bench/RESULTS.md).
inline constexpr double default_region_share = 0.45;

struct BandOptions {
  double region_share = default_region_share;
  double map_noise_m = 0.0;  // by which the map's walls may be off
};

struct Band {
  float low_m = 0.0F;
  float high_m = 0.0F;  // +inf: nothing hit is as good

  [[nodiscard]] bool contains(float simulated_m) const {
    return simulated_m >= low_m && simulated_m <= high_m;
  }
  // The robot's beam went on behind the wall that the map has there.
  [[nodiscard]] bool passes_wall(float simulated_m) const { return simulated_m < low_m; }
};

class BeamBands {
 public:
  BeamBands(const Scan& scan, std::span<const FocusLevel> levels, const BandOptions& options);

  // The scan's valid beams, by their index in the sensor.
  [[nodiscard]] std::size_t size() const { return beams_.size(); }
  [[nodiscard]] std::size_t sensor_beam(std::size_t beam) const { return beams_[beam]; }
  [[nodiscard]] const Band& band(std::size_t level, std::size_t beam) const {
    return bands_[level * beams_.size() + beam];
  }

 private:
  std::vector<std::size_t> beams_;
  std::vector<Band> bands_;  // level by level
};

}  // namespace landfall::internal
