#include "raycast/distance_walk.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "raycast/march_batch.hpp"

namespace landfall::raycast {
namespace {

// From the frame of the caller to the grid's axes, in cells.
class ToGrid {
 public:
  ToGrid(const Pose& T_frame_grid, double resolution_m)
      : from_(T_frame_grid),
        c_(std::cos(T_frame_grid.theta_rad)),
        s_(std::sin(T_frame_grid.theta_rad)),
        cells_per_m_(1.0 / resolution_m) {}

  [[nodiscard]] double x(double x_m, double y_m) const {
    return cells_per_m_ * (c_ * (x_m - from_.x_m) + s_ * (y_m - from_.y_m));
  }
  [[nodiscard]] double y(double x_m, double y_m) const {
    return cells_per_m_ * (c_ * (y_m - from_.y_m) - s_ * (x_m - from_.x_m));
  }
  [[nodiscard]] GridPose operator()(const Pose& pose) const {
    const double theta_rad = pose.theta_rad - from_.theta_rad;
    return {.x = x(pose.x_m, pose.y_m),
            .y = y(pose.x_m, pose.y_m),
            .c = static_cast<float>(std::cos(theta_rad)),
            .s = static_cast<float>(std::sin(theta_rad))};
  }
  void add(const Ray& ray, MarchBatch& batch) const {
    const double dx = c_ * ray.dx + s_ * ray.dy;
    const double dy = c_ * ray.dy - s_ * ray.dx;
    batch.add(x(ray.x_m, ray.y_m), y(ray.x_m, ray.y_m), static_cast<float>(dx), static_cast<float>(dy),
              static_cast<float>(cells_per_m_ * ray.range_max_m));
  }

 private:
  Pose from_;
  double c_, s_;
  double cells_per_m_;
};

}  // namespace

DistanceWalk::DistanceWalk(const PlacedGrid& placed)
    : squares_(placed.grid),
      width_cells_(placed.grid.width_cells),
      height_cells_(placed.grid.height_cells),
      resolution_m_(placed.resolution_m),
      T_frame_grid_(placed.T_frame_grid) {}

void DistanceWalk::cast_fans(std::span<const Pose> poses, std::span<const Beam> beams,
                             std::span<float> ranges_m) const {
  assert(ranges_m.size() == poses.size() * beams.size());
  const ToGrid to_grid(T_frame_grid_, resolution_m_);
  const FanBeams fan(beams, resolution_m_);
  const std::size_t rays = fan.index.size();
  if (rays == 0) return;
  const auto m_per_cell = static_cast<float>(resolution_m_);
  MarchBatch batch(squares_, width_cells_, height_cells_);
  std::size_t pose_begin = 0, next = 0;  // where the next range of the batch goes
  const auto march = [&] {
    for (const float range : batch.march()) {
      ranges_m[pose_begin + fan.index[next]] = m_per_cell * range;
      if (++next < rays) continue;
      next = 0;
      pose_begin += beams.size();
    }
  };
  for (const Pose& pose : poses) {
    const GridPose grid_pose = to_grid(pose);
    for (std::size_t first = 0; first < rays;) {
      const std::size_t count = std::min(rays - first, batch.room());
      batch.add_fan(fan, first, count, grid_pose);
      first += count;
      if (batch.room() == 0) march();
    }
  }
  march();
}

void DistanceWalk::cast_rays(std::span<const Ray> rays, std::span<float> ranges_m) const {
  assert(ranges_m.size() == rays.size());
  const ToGrid to_grid(T_frame_grid_, resolution_m_);
  MarchBatch batch(squares_, width_cells_, height_cells_);
  for (std::size_t first = 0; first < rays.size(); first += MarchBatch::capacity) {
    const std::size_t count = std::min(MarchBatch::capacity, rays.size() - first);
    for (std::size_t i = 0; i < count; ++i) to_grid.add(rays[first + i], batch);
    const std::span<const float> ranges = batch.march();
    for (std::size_t i = 0; i < count; ++i)
      ranges_m[first + i] = static_cast<float>(resolution_m_) * ranges[i];
  }
}

}  // namespace landfall::raycast
