#include "raycast/wall_trace.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "raycast/ray_beams.hpp"
#include "raycast/wedge.hpp"

namespace landfall::raycast {
namespace {

Box bounds(std::span<const Segment> walls) {
  if (walls.empty()) return {.min_x_m = 0.0, .min_y_m = 0.0, .max_x_m = 0.0, .max_y_m = 0.0};
  Box box;
  for (const Segment& wall : walls) box.add(wall);
  return box;
}

double center_x(const Box& box) {
  return 0.5 * (box.min_x_m + box.max_x_m);
}
double center_y(const Box& box) {
  return 0.5 * (box.min_y_m + box.max_y_m);
}

}  // namespace

WallTrace::WallTrace(std::span<const Segment> walls)
    : center_x_m_(center_x(bounds(walls))),
      center_y_m_(center_y(bounds(walls))),
      embree_(walls, center_x_m_, center_y_m_) {}

void WallTrace::cast_fan(const Pose& pose, const RayBeams& rays, std::span<float> ranges_m) const {
  const auto x_m = static_cast<float>(pose.x_m - center_x_m_);
  const auto y_m = static_cast<float>(pose.y_m - center_y_m_);
  const auto c = static_cast<float>(std::cos(pose.theta_rad));
  const auto s = static_cast<float>(std::sin(pose.theta_rad));
  std::array<float, packet_rays> lanes_m;
  for (std::size_t first = 0; first < rays.size(); first += packet_rays) {
    const std::size_t count = std::min(packet_rays, rays.size() - first);
    const std::size_t p = first / packet_rays;
    embree_.trace(rays.packet_from(p, x_m, y_m, c, s), count, rays.coherence(p), lanes_m);
    for (std::size_t i = 0; i < count; ++i) ranges_m[rays.beam_index(first + i)] = lanes_m[i];
  }
}

void WallTrace::cast_fans(std::span<const Pose> poses, std::span<const Beam> beams,
                          std::span<float> ranges_m) const {
  assert(ranges_m.size() == poses.size() * beams.size());
  const RayBeams rays(beams);
  for (std::size_t i = 0; i < poses.size(); ++i)
    cast_fan(poses[i], rays, ranges_m.subspan(i * beams.size(), beams.size()));
}

void WallTrace::cast_rays(std::span<const Ray> rays, std::span<float> ranges_m) const {
  assert(ranges_m.size() == rays.size());
  RayPacket packet{};
  for (std::size_t first = 0; first < rays.size(); first += packet_rays) {
    const std::size_t count = std::min(packet_rays, rays.size() - first);
    for (std::size_t i = 0; i < count; ++i) {
      const Ray& ray = rays[first + i];
      packet.x_m[i] = static_cast<float>(ray.x_m - center_x_m_);
      packet.y_m[i] = static_cast<float>(ray.y_m - center_y_m_);
      packet.dx[i] = ray.dx;
      packet.dy[i] = ray.dy;
      packet.range_max_m[i] = ray.range_max_m;
    }
    embree_.trace(packet, count, Coherence::incoherent, ranges_m.subspan(first, count));
  }
}

}  // namespace landfall::raycast
