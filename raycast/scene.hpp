// Walls -> a scene -> batches of ranges. Plain values in one frame of the caller's choice, metres and
// radians. Coordinates are taken relative to the scene's centre before they become floats, so that maps
// with origins kilometres away lose nothing.
#pragma once

#include <cstddef>
#include <memory>
#include <span>

namespace landfall::raycast {

struct Segment {
  double ax_m, ay_m, bx_m, by_m;
};

struct Pose {
  double x_m, y_m, theta_rad;
};

// Mount in the frame of the pose it is cast from. A half-angle makes it a cone.
struct Beam {
  double x_m, y_m, theta_rad;
  double half_angle_rad;
  double range_max_m;
};

struct Ray {
  double x_m, y_m;
  float dx, dy;  // unit direction
  float range_max_m;
};

// Immutable after construction; every const function is safe from any thread. It starts no threads.
// Throws std::runtime_error where Embree does not come up, std::bad_alloc where memory runs out.
//
// Walls are lines without inside: a ray that starts within a thick wall meets that wall's far face, and a
// ray that starts on a wall may or may not see it. No ray passes between walls that share an end point.
class Scene {
 public:
  explicit Scene(std::span<const Segment> walls);
  ~Scene();
  Scene(Scene&&) noexcept;
  Scene& operator=(Scene&&) noexcept;

  // ranges_m[i * beams.size() + b]: beam b from poses[i]; +inf: nothing within its range_max_m.
  // Neighbouring beams are traced together, which pays where they point to similar directions.
  void cast_fans(std::span<const Pose> poses, std::span<const Beam> beams, std::span<float> ranges_m) const;
  // One range per ray; the rays need have nothing in common.
  void cast_rays(std::span<const Ray> rays, std::span<float> ranges_m) const;

  [[nodiscard]] std::size_t memory_bytes() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace landfall::raycast
