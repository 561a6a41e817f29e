// One scan, prepared for other scans to be matched to it: its surface points, and a grid in its robot's
// frame of what it saw where.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/align/surfaces.hpp"

namespace landfall::internal {

// Echoes beyond are sparse and say little of a step.
inline constexpr double farthest_echo_m = 20.0;
// What a point of another scan is worth, of 255, where this one saw nothing at all. Where it saw free space
// the point is worth nothing, on a surface up to 255.
inline constexpr std::uint8_t unseen_value = 60;

class ScanView {
 public:
  ScanView(const Scan& scan, double resolution_m);

  [[nodiscard]] std::span<const SurfacePoint> points() const { return points_; }
  [[nodiscard]] double resolution_m() const { return resolution_m_; }
  [[nodiscard]] int width_cells() const { return width_; }
  [[nodiscard]] int height_cells() const { return height_; }

  struct Cell {
    int col;
    int row;
  };
  // The cell of a point in the robot's frame; it may lie off the grid.
  [[nodiscard]] Cell cell_of(double x_m, double y_m) const;
  // Off the grid: -1.
  [[nodiscard]] std::ptrdiff_t index_of(double x_m, double y_m) const {
    const Cell cell = cell_of(x_m, y_m);
    const bool inside = cell.col >= 0 && cell.col < width_ && cell.row >= 0 && cell.row < height_;
    return inside ? static_cast<std::ptrdiff_t>(cell.row) * width_ + cell.col : -1;
  }

  // Row by row: surfaces, blurred, on what was seen as free (0) or not at all (unseen_value).
  [[nodiscard]] std::span<const std::uint8_t> field() const { return field_; }
  // The same without the surfaces.
  [[nodiscard]] std::uint8_t background(std::ptrdiff_t index) const {
    return background_[static_cast<std::size_t>(index)];
  }
  // The surface point nearest to a cell's centre; nullptr where none is within half a metre.
  [[nodiscard]] const SurfacePoint* nearest(std::ptrdiff_t index) const {
    const std::uint16_t point = nearest_[static_cast<std::size_t>(index)];
    return point == no_point ? nullptr : &points_[point];
  }

 private:
  static constexpr std::uint16_t no_point = 0xffff;

  void lay_out(std::span<const Echo> echoes);
  void trace_free_space(std::span<const Echo> echoes);
  void blur_surfaces(std::span<const Echo> echoes);
  void index_points();

  double resolution_m_;
  double low_x_m_ = 0.0;
  double low_y_m_ = 0.0;
  int width_ = 0;
  int height_ = 0;
  std::vector<SurfacePoint> points_;
  std::vector<std::uint8_t> field_;
  std::vector<std::uint8_t> background_;
  std::vector<std::uint16_t> nearest_;
};

}  // namespace landfall::internal
