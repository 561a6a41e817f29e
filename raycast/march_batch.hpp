// Rays on their way through a DistanceWalk: placed one by one or as parts of fans, then marched together.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "raycast/free_squares.hpp"
#include "raycast/values.hpp"

namespace landfall::raycast {

// In cells of the grid, along its axes.
struct GridPose {
  double x, y;
  float c, s;  // cosine and sine of the heading
};

// The beams of a sensor that are rays, in cells.
struct FanBeams {
  FanBeams(std::span<const Beam> beams, double resolution_m);

  std::vector<std::size_t> index;  // among the beams given
  std::vector<float> x, y, dx, dy, range_max;
  bool near_pose = true;  // all mounts are so near that floats hold them well
};

class MarchBatch {
 public:
  static constexpr std::size_t capacity = 256;

  MarchBatch(const FreeSquareTable& squares, int width_cells, int height_cells)
      : squares_(squares), width_cells_(width_cells), height_cells_(height_cells) {}

  [[nodiscard]] std::size_t room() const { return capacity - size_; }
  // A ray from anywhere, also from outside the grid.
  void add(double x, double y, float dx, float dy, float range_max);
  // Beams [first, first + count) from one pose.
  void add_fan(const FanBeams& beams, std::size_t first, std::size_t count, const GridPose& pose);
  // The ranges (in cells) of all rays added since the last march, in their order, until the next one.
  std::span<const float> march();

 private:
  using Floats = std::array<float, capacity>;

  void place(std::size_t ray, double x, double y, float dx, float dy, float range_max);
  void place_beam(std::size_t ray, const FanBeams& beams, std::size_t beam, const GridPose& pose);
  [[nodiscard]] float leave_obstacle(std::size_t ray) const;

  const FreeSquareTable& squares_;
  int width_cells_, height_cells_;
  std::size_t size_ = 0;
  alignas(64) std::array<std::int32_t, capacity> cell_;
  alignas(64) Floats x_, y_, dx_, dy_, range_max_;
  Floats skipped_;  // before the ray entered the grid
  Floats range_;
};

}  // namespace landfall::raycast
