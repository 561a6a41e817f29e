// Rays against walls by Embree, in packets.
#pragma once

#include <cstddef>
#include <span>

#include "raycast/embree_walls.hpp"
#include "raycast/values.hpp"

namespace landfall::raycast {

class RayBeams;

// Immutable after construction. Answers as Scene does.
class WallTrace {
 public:
  explicit WallTrace(std::span<const Segment> walls);

  // As Scene::cast_fans, but for beams with a half-angle, whose ranges it leaves as they are.
  void cast_fans(std::span<const Pose> poses, std::span<const Beam> beams, std::span<float> ranges_m) const;
  void cast_rays(std::span<const Ray> rays, std::span<float> ranges_m) const;
  [[nodiscard]] std::size_t memory_bytes() const { return embree_.memory_bytes(); }

 private:
  void cast_fan(const Pose& pose, const RayBeams& rays, std::span<float> ranges_m) const;

  double center_x_m_, center_y_m_;
  EmbreeWalls embree_;
};

}  // namespace landfall::raycast
