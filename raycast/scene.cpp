#include "raycast/scene.hpp"

#include <algorithm>
#include <atomic>
#include <cassert>
#include <cmath>
#include <mutex>
#include <optional>
#include <utility>

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

}  // namespace

struct Scene::State {
  State(const MapShape& map_shape, MakeWalls make) : shape(map_shape), make_walls(std::move(make)) {}

  const SegmentTree& segment_tree() const {
    std::call_once(tree_once, [this] {
      tree.emplace(make_walls());
      tree_bytes = tree->memory_bytes();
    });
    return *tree;
  }
  // Calls cast(way) with the way of the pattern.
  template <typename Cast>
  void with_way(Pattern pattern, const Cast& cast) const {
    if (choose_way(shape, pattern) == Way::distance_walk)
      cast(*walk);
    else
      cast(*trace);
  }

  MapShape shape;
  MakeWalls make_walls;
  std::size_t kept_bytes = 0;
  std::optional<DistanceWalk> walk;
  std::optional<WallTrace> trace;
  // Built when the first cone is cast: most sensors have none.
  mutable std::once_flag tree_once;
  mutable std::optional<SegmentTree> tree;
  mutable std::atomic<std::size_t> tree_bytes = 0;
};

Scene::Scene(std::span<const Segment> walls)
    : state_(std::make_unique<State>(
          MapShape{}, [kept = std::vector<Segment>(walls.begin(), walls.end())] { return kept; })) {
  state_->trace.emplace(walls);
  state_->kept_bytes = walls.size_bytes();
}

Scene::Scene(const PlacedGrid& grid, MakeWalls make_faces)
    : state_(std::make_unique<State>(
          MapShape{.width_cells = grid.grid.width_cells, .height_cells = grid.grid.height_cells},
          std::move(make_faces))) {
  for (const Pattern pattern : {Pattern::fan, Pattern::single_rays}) {
    const Way chosen = way(pattern);
    if (chosen == Way::distance_walk && !state_->walk) state_->walk.emplace(grid);
    if (chosen == Way::embree && !state_->trace) state_->trace.emplace(state_->make_walls());
  }
}

Scene::~Scene() = default;
Scene::Scene(Scene&&) noexcept = default;
Scene& Scene::operator=(Scene&&) noexcept = default;

Way Scene::way(Pattern pattern) const {
  return choose_way(state_->shape, pattern);
}

void Scene::cast_fans(std::span<const Pose> poses, std::span<const Beam> beams,
                      std::span<float> ranges_m) const {
  assert(ranges_m.size() == poses.size() * beams.size());
  state_->with_way(Pattern::fan, [&](const auto& rays) { rays.cast_fans(poses, beams, ranges_m); });
  if (std::none_of(beams.begin(), beams.end(), is_cone)) return;
  const SegmentTree& tree = state_->segment_tree();
  for (std::size_t i = 0; i < poses.size(); ++i)
    for (std::size_t b = 0; b < beams.size(); ++b)
      if (is_cone(beams[b]))
        ranges_m[i * beams.size() + b] =
            static_cast<float>(tree.nearest_in_cone(cone_from(poses[i], beams[b])));
}

void Scene::cast_rays(std::span<const Ray> rays, std::span<float> ranges_m) const {
  state_->with_way(Pattern::single_rays, [&](const auto& way) { way.cast_rays(rays, ranges_m); });
}

std::size_t Scene::memory_bytes() const {
  return state_->kept_bytes + (state_->walk ? state_->walk->memory_bytes() : 0) +
         (state_->trace ? state_->trace->memory_bytes() : 0) + state_->tree_bytes;
}

}  // namespace landfall::raycast
