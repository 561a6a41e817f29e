#include "raycast/scene.hpp"

#include <algorithm>
#include <atomic>
#include <cassert>
#include <cmath>
#include <mutex>
#include <optional>
#include <utility>
#include <variant>

#include "raycast/distance_walk.hpp"
#include "raycast/segment_tree.hpp"
#include "raycast/wall_trace.hpp"

namespace landfall::raycast {
namespace {

Cone cone_from(const Pose& pose, const Beam& beam) {
  const double c = std::cos(pose.theta_rad);
  const double s = std::sin(pose.theta_rad);
  return {.x_m = pose.x_m + c * beam.x_m - s * beam.y_m,
          .y_m = pose.y_m + s * beam.x_m + c * beam.y_m,
          .theta_rad = pose.theta_rad + beam.theta_rad,
          .half_angle_rad = beam.half_angle_rad,
          .range_max_m = beam.range_max_m};
}

bool is_cone(const Beam& beam) {
  return beam.half_angle_rad > 0.0;
}

using RayCaster = std::variant<DistanceWalk, WallTrace>;

RayCaster ray_caster_over(const PlacedGrid& grid, const Scene::MakeWalls& make_faces) {
  const MapShape shape{.width_cells = grid.grid.width_cells, .height_cells = grid.grid.height_cells};
  if (choose_way(shape) == Way::distance_walk) return RayCaster(std::in_place_type<DistanceWalk>, grid);
  return RayCaster(std::in_place_type<WallTrace>, make_faces());
}

// Its tree is built when the first cone is cast: most sensors have none.
class ConeCaster {
 public:
  explicit ConeCaster(Scene::MakeWalls make_walls) : make_walls_(std::move(make_walls)) {}

  // The ranges of beams with a half-angle.
  void cast_fans(std::span<const Pose> poses, std::span<const Beam> beams, std::span<float> ranges_m) const {
    if (std::none_of(beams.begin(), beams.end(), is_cone)) return;
    const SegmentTree& walls = tree();
    for (std::size_t i = 0; i < poses.size(); ++i)
      for (std::size_t b = 0; b < beams.size(); ++b)
        if (is_cone(beams[b]))
          ranges_m[i * beams.size() + b] =
              static_cast<float>(walls.nearest_in_cone(cone_from(poses[i], beams[b])));
  }
  [[nodiscard]] std::size_t memory_bytes() const { return memory_bytes_; }

 private:
  const SegmentTree& tree() const {
    std::call_once(once_, [this] {
      tree_.emplace(make_walls_());
      memory_bytes_ = tree_->memory_bytes();
    });
    return *tree_;
  }

  Scene::MakeWalls make_walls_;
  mutable std::once_flag once_;
  mutable std::optional<SegmentTree> tree_;
  mutable std::atomic<std::size_t> memory_bytes_ = 0;
};

}  // namespace

struct Scene::State {
  // A plan, kept for its cones.
  explicit State(std::span<const Segment> walls)
      : rays(std::in_place_type<WallTrace>, walls),
        cones([kept = std::vector<Segment>(walls.begin(), walls.end())] { return kept; }),
        kept_bytes(walls.size_bytes()) {}
  State(const PlacedGrid& grid, MakeWalls make_faces)
      : rays(ray_caster_over(grid, make_faces)), cones(std::move(make_faces)) {}

  RayCaster rays;
  ConeCaster cones;
  std::size_t kept_bytes = 0;
};

Scene::Scene(std::span<const Segment> walls) : state_(std::make_unique<State>(walls)) {}

Scene::Scene(const PlacedGrid& grid, MakeWalls make_faces)
    : state_(std::make_unique<State>(grid, std::move(make_faces))) {}

Scene::~Scene() = default;
Scene::Scene(Scene&&) noexcept = default;
Scene& Scene::operator=(Scene&&) noexcept = default;

Way Scene::way() const {
  return std::holds_alternative<DistanceWalk>(state_->rays) ? Way::distance_walk : Way::embree;
}

void Scene::cast_fans(std::span<const Pose> poses, std::span<const Beam> beams,
                      std::span<float> ranges_m) const {
  assert(ranges_m.size() == poses.size() * beams.size());
  std::visit([&](const auto& rays) { rays.cast_fans(poses, beams, ranges_m); }, state_->rays);
  state_->cones.cast_fans(poses, beams, ranges_m);
}

void Scene::cast_rays(std::span<const Ray> rays, std::span<float> ranges_m) const {
  std::visit([&](const auto& caster) { caster.cast_rays(rays, ranges_m); }, state_->rays);
}

std::size_t Scene::memory_bytes() const {
  return state_->kept_bytes + state_->cones.memory_bytes() +
         std::visit([](const auto& rays) { return rays.memory_bytes(); }, state_->rays);
}

}  // namespace landfall::raycast
