// The beams of a sensor that are rays, grouped into packets, in the sensor's own frame.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "raycast/embree_walls.hpp"
#include "raycast/values.hpp"

namespace landfall::raycast {

class RayBeams {
 public:
  // Passes over beams with a half-angle.
  explicit RayBeams(std::span<const Beam> beams);

  [[nodiscard]] std::size_t size() const { return beam_index_.size(); }
  // Which of the beams given is ray i; it is lane i % packet_rays of packet i / packet_rays.
  [[nodiscard]] std::size_t beam_index(std::size_t i) const { return beam_index_[i]; }
  [[nodiscard]] Coherence coherence(std::size_t packet) const { return coherence_[packet]; }
  // A packet as seen from the pose (x_m, y_m) with heading (c, s) = (cos, sin).
  [[nodiscard]] RayPacket packet_from(std::size_t packet, float x_m, float y_m, float c, float s) const;

 private:
  std::vector<RayPacket> packets_;
  std::vector<Coherence> coherence_;
  std::vector<std::size_t> beam_index_;
};

}  // namespace landfall::raycast
