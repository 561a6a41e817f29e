#include "raycast/scene.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cassert>
#include <cmath>
#include <mutex>
#include <optional>
#include <vector>

#include "raycast/embree_walls.hpp"
#include "raycast/ray_beams.hpp"
#include "raycast/segment_tree.hpp"

namespace landfall::raycast {
namespace {

Box bounds(std::span<const Segment> walls) {
  if (walls.empty()) return {.min_x_m = 0.0, .min_y_m = 0.0, .max_x_m = 0.0, .max_y_m = 0.0};
  Box box;
  for (const Segment& wall : walls) box.add(wall);
  return box;
}

Cone cone_from(const Pose& pose, const Beam& beam) {
  const double c = std::cos(pose.theta_rad);
  const double s = std::sin(pose.theta_rad);
  return {.x_m = pose.x_m + c * beam.x_m - s * beam.y_m,
          .y_m = pose.y_m + s * beam.x_m + c * beam.y_m,
          .theta_rad = pose.theta_rad + beam.theta_rad,
          .half_angle_rad = beam.half_angle_rad,
          .range_max_m = beam.range_max_m};
}

}  // namespace

struct Scene::State {
  State(std::span<const Segment> all_walls, const Box& box)
      : center_x_m(0.5 * (box.min_x_m + box.max_x_m)),
        center_y_m(0.5 * (box.min_y_m + box.max_y_m)),
        walls(all_walls.begin(), all_walls.end()),
        embree(all_walls, center_x_m, center_y_m) {}

  const SegmentTree& segment_tree() const {
    std::call_once(tree_once, [this] {
      tree.emplace(walls);
      tree_bytes = tree->memory_bytes();
    });
    return *tree;
  }
  void cast_ray_beams(const Pose& pose, const RayBeams& rays, std::span<float> ranges_m) const;

  double center_x_m;
  double center_y_m;
  std::vector<Segment> walls;
  EmbreeWalls embree;
  // Built when the first cone is cast: most sensors have none.
  mutable std::once_flag tree_once;
  mutable std::optional<SegmentTree> tree;
  mutable std::atomic<std::size_t> tree_bytes = 0;
};

void Scene::State::cast_ray_beams(const Pose& pose, const RayBeams& rays, std::span<float> ranges_m) const {
  const auto x_m = static_cast<float>(pose.x_m - center_x_m);
  const auto y_m = static_cast<float>(pose.y_m - center_y_m);
  const auto c = static_cast<float>(std::cos(pose.theta_rad));
  const auto s = static_cast<float>(std::sin(pose.theta_rad));
  std::array<float, packet_rays> lanes_m;
  for (std::size_t first = 0; first < rays.size(); first += packet_rays) {
    const std::size_t count = std::min(packet_rays, rays.size() - first);
    const std::size_t p = first / packet_rays;
    embree.trace(rays.packet_from(p, x_m, y_m, c, s), count, rays.coherence(p), lanes_m);
    for (std::size_t i = 0; i < count; ++i) ranges_m[rays.beam_index(first + i)] = lanes_m[i];
  }
}

Scene::Scene(std::span<const Segment> walls) : state_(std::make_unique<State>(walls, bounds(walls))) {}
Scene::~Scene() = default;
Scene::Scene(Scene&&) noexcept = default;
Scene& Scene::operator=(Scene&&) noexcept = default;

void Scene::cast_fans(std::span<const Pose> poses, std::span<const Beam> beams,
                      std::span<float> ranges_m) const {
  assert(ranges_m.size() == poses.size() * beams.size());
  const RayBeams rays(beams);
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const std::span<float> pose_ranges_m = ranges_m.subspan(i * beams.size(), beams.size());
    state_->cast_ray_beams(poses[i], rays, pose_ranges_m);
    if (rays.size() == beams.size()) continue;
    for (std::size_t b = 0; b < beams.size(); ++b)
      if (beams[b].half_angle_rad > 0.0)
        pose_ranges_m[b] =
            static_cast<float>(state_->segment_tree().nearest_in_cone(cone_from(poses[i], beams[b])));
  }
}

void Scene::cast_rays(std::span<const Ray> rays, std::span<float> ranges_m) const {
  assert(ranges_m.size() == rays.size());
  RayPacket packet{};
  for (std::size_t first = 0; first < rays.size(); first += packet_rays) {
    const std::size_t count = std::min(packet_rays, rays.size() - first);
    for (std::size_t i = 0; i < count; ++i) {
      const Ray& ray = rays[first + i];
      packet.x_m[i] = static_cast<float>(ray.x_m - state_->center_x_m);
      packet.y_m[i] = static_cast<float>(ray.y_m - state_->center_y_m);
      packet.dx[i] = ray.dx;
      packet.dy[i] = ray.dy;
      packet.range_max_m[i] = ray.range_max_m;
    }
    state_->embree.trace(packet, count, Coherence::incoherent, ranges_m.subspan(first, count));
  }
}

std::size_t Scene::memory_bytes() const {
  return state_->walls.capacity() * sizeof(Segment) + state_->embree.memory_bytes() + state_->tree_bytes;
}

}  // namespace landfall::raycast
