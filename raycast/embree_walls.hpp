// Walls as an Embree scene of upright quads; rays travel in the plane z = 0.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <span>

#include "raycast/embree.hpp"
#include "raycast/values.hpp"

namespace landfall::raycast {

// Of Embree's widths 8 is the fastest from 0.25 to 1 degree between beams (bench_raycast).
inline constexpr std::size_t packet_rays = 8;

// Rays relative to the walls' centre. Lanes at and after `count` are not traced.
struct alignas(32) RayPacket {
  std::array<float, packet_rays> x_m, y_m, dx, dy, range_max_m;
};

class EmbreeWalls {
 public:
  // Takes the walls relative to (center_x_m, center_y_m).
  EmbreeWalls(std::span<const Segment> walls, double center_x_m, double center_y_m);
  ~EmbreeWalls();
  EmbreeWalls(const EmbreeWalls&) = delete;
  EmbreeWalls& operator=(const EmbreeWalls&) = delete;

  // ranges_m: one per traced lane; +inf: nothing within the lane's range_max_m.
  void trace(const RayPacket& packet, std::size_t count, Coherence coherence,
             std::span<float> ranges_m) const;
  // What Embree holds for the scene.
  [[nodiscard]] std::size_t memory_bytes() const;

 private:
  std::atomic<std::ptrdiff_t> memory_bytes_ = 0;  // Embree's threads report here while they build
  RTCDevice device_;
  RTCScene scene_;
};

}  // namespace landfall::raycast
