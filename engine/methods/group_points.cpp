#include "engine/methods/group_points.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>
#include <vector>

#include "kernels/point_windows.hpp"

namespace landfall::internal {
namespace {

// What a build needs meanwhile; kept, for a search builds hundreds.
struct Workspace {
  std::vector<std::int32_t> col_half, row_half, size_halves, run_begin;
  std::vector<std::int32_t> plane, col, row, weight;

  void resize(std::size_t points) {
    for (auto* numbers : {&col_half, &row_half, &size_halves, &run_begin, &plane, &col, &row, &weight})
      numbers->resize(points + kernels::point_padding);
  }
  [[nodiscard]] kernels::MergedWindows merged() {
    return {.plane = plane.data(), .col = col.data(), .row = row.data(), .weight = weight.data()};
  }
};

}  // namespace

void GroupPoints::build(const EndPoints& points, const Lattice& lattice, const BoundTable& table, int first,
                        int last) {
  const double step_rad = lattice.heading_step_rad();
  const double center_rad = 0.5 * (first + last - 1) * step_rad;
  const double half_rad = 0.5 * (last - 1 - first) * step_rad;
  static thread_local Workspace work;
  work.resize(points.size());
  kernels::point_windows(points.x_cells_by_beam.data(), points.y_cells_by_beam.data(), points.size(),
                         {.cos_center = std::cos(center_rad),
                          .sin_center = std::sin(center_rad),
                          .sin_half = half_rad >= std::numbers::pi / 2.0 ? 1.0 : std::sin(half_rad),
                          .cos_half = std::cos(half_rad)},
                         {.width_cells = lattice.width_cells,
                          .height_cells = lattice.height_cells,
                          .block_cells = table.block_cells()},
                         work.col_half.data(), work.row_half.data(), work.size_halves.data());
  const kernels::MergedWindows merged = work.merged();
  merged_ = kernels::merge_windows(work.col_half.data(), work.row_half.data(), work.size_halves.data(),
                                   points.size(), table.shelf(), work.run_begin.data(), merged);
  // A point of weight w stands in at most w lists.
  if (room_ != points.size() + kernels::point_padding) {
    room_ = points.size() + kernels::point_padding;
    numbers_ = std::make_unique_for_overwrite<std::int32_t[]>(4 * room_);
  }
  lists_ = std::max(1, static_cast<int>(std::bit_width(static_cast<std::uint32_t>(merged_.weights))));
  std::size_t at = 0;
  for (int list = 0; list < lists_; ++list) {
    list_begin_[static_cast<std::size_t>(list)] = static_cast<std::int32_t>(at);
    at += kernels::list_windows(merged, merged_.windows, lists_ - 1 - list, table.shelf().stride,
                                numbers(0) + at, numbers(1) + at, numbers(2) + at, numbers(3) + at);
    list_end_[static_cast<std::size_t>(list)] = static_cast<std::int32_t>(at);
  }
}

kernels::BoundPoints GroupPoints::view() const {
  return {.plane = numbers(0),
          .col = numbers(1),
          .row = numbers(2),
          .first_byte = numbers(3),
          .list_begin = list_begin_.data(),
          .list_end = list_end_.data(),
          .lists = lists_,
          .least_col = merged_.least_col,
          .most_col = merged_.most_col,
          .least_row = merged_.least_row,
          .most_row = merged_.most_row};
}

}  // namespace landfall::internal
