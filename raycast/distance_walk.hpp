// Rays through a grid by its distances to the nearest obstacle (Hart 1996, Sphere Tracing), with squares for
// spheres: large steps in the open, cell by cell beside walls. The ranges are those of the walk from cell to
// cell but for the rounding of floats.
#pragma once

#include <cstddef>
#include <span>

#include "raycast/free_squares.hpp"
#include "raycast/values.hpp"

namespace landfall::raycast {

// Immutable after construction. Answers as Scene does over the grid's faces: a ray that starts within an
// obstacle ends where it leaves that.
class DistanceWalk {
 public:
  // A grid that FreeSquareTable can hold.
  explicit DistanceWalk(const PlacedGrid& placed);

  // As Scene::cast_fans, but for beams with a half-angle, whose ranges it leaves as they are.
  void cast_fans(std::span<const Pose> poses, std::span<const Beam> beams, std::span<float> ranges_m) const;
  void cast_rays(std::span<const Ray> rays, std::span<float> ranges_m) const;
  [[nodiscard]] std::size_t memory_bytes() const { return squares_.memory_bytes(); }

 private:
  FreeSquareTable squares_;
  int width_cells_, height_cells_;
  double resolution_m_;
  Pose T_frame_grid_;
};

}  // namespace landfall::raycast
