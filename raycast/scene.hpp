// A map -> a scene -> batches of ranges. Coordinates are taken relative to the scene's centre or to a grid's
// cell before they become floats, so that maps with origins kilometres away lose nothing.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "raycast/choose_way.hpp"
#include "raycast/values.hpp"

namespace landfall::raycast {

// Immutable after construction; every const function is safe from any thread. It starts no threads.
// Throws std::runtime_error where Embree does not come up, std::bad_alloc where memory runs out.
//
// Walls are lines without inside: a ray that starts within a thick wall meets that wall's far face, and a
// ray that starts on a wall may or may not see it. No ray passes between walls that share an end point.
class Scene {
 public:
  using MakeWalls = std::function<std::vector<Segment>()>;

  // A plan.
  explicit Scene(std::span<const Segment> walls);
  // A grid, which is not needed afterwards. make_faces() gives the faces between its occupied cells and the
  // others; it is called when they are first needed.
  Scene(const PlacedGrid& grid, MakeWalls make_faces);
  ~Scene();
  Scene(Scene&&) noexcept;
  Scene& operator=(Scene&&) noexcept;

  // How beams without a half-angle are cast, chosen once; the others by segment_tree.
  [[nodiscard]] Way way() const;

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
