// The surfaces of a map under construction, finer than its cells: means of the points that scans saw, with
// normals, one or two (the faces of a thin wall) in every square of 10 cm. A wall converges to its mean
// however far single echoes stray, and a scan matched point to line finds its place to millimetres.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "engine/align/point_to_line.hpp"
#include "engine/align/surfaces.hpp"
#include "engine/mapping/slam/growing_array.hpp"
#include "landfall/pose2.hpp"

namespace landfall::internal {

class SurfaceMap {
 public:
  SurfaceMap() : slots_(Slots{}, 32) {}

  void add_scan(std::span<const SurfacePoint> points_robot, const Pose2& T_map_robot);
  // Forgets the surfaces there: what was seen has gone.
  void forget(std::span<const Point2> points_map);

  // Gauss-Newton from a start; where surfaces do not say (along a corridor), the pose stays near it.
  [[nodiscard]] Pose2 refine(std::span<const SurfacePoint> points_robot, const Pose2& T_map_start) const;
  // How far the nearest surface that faces the same way runs from here, without sign; nothing where none is
  // near.
  [[nodiscard]] std::optional<double> distance(const Point2& p_map, const Point2& normal_map) const;
  // A place before a surface, within what noise may move its echoes, that a ray to p_end passes without going
  // through the surface: an echo there was noise of the wall's, which the ray says nothing about.
  [[nodiscard]] bool is_noise_of_a_wall(const Point2& p_map, const Point2& p_end_map, double noise_m) const;
  [[nodiscard]] std::size_t memory_bytes() const {
    return slots_.memory_bytes() + surfaces_.capacity() * sizeof(Surface);
  }

 private:
  struct Surface {
    Point2 mean;
    Point2 normal;      // unit length
    Point2 normal_sum;  // of the points'
    int count = 0;

    void add(const Point2& p_map, const Point2& normal_map);
    // Along the normal.
    [[nodiscard]] double distance(const Point2& p_map) const {
      return normal.x_m * (p_map.x_m - mean.x_m) + normal.y_m * (p_map.y_m - mean.y_m);
    }
  };
  static constexpr std::int32_t none = -1;
  struct Slots {
    std::int32_t surface[2] = {none, none};
  };

  [[nodiscard]] static CellIndex square_of(const Point2& p_map);
  void add(const Point2& p_map, const Point2& normal_map);
  [[nodiscard]] PairNormal linearise(std::span<const SurfacePoint> points_robot, const Pose2& T_map_robot,
                                     double gate_m) const;
  // The nearest that faces the same way, within the gate; none where there is none.
  [[nodiscard]] std::int32_t nearest(const Point2& p_map, const Point2& normal_map, double gate_m) const;

  GrowingArray<Slots> slots_;
  std::vector<Surface> surfaces_;
};

}  // namespace landfall::internal
