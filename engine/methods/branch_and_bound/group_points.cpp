#include "engine/methods/branch_and_bound/group_points.hpp"

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

  void resize(std::size_t points) {
    for (auto* numbers : {&col_half, &row_half, &size_halves, &run_begin})
      numbers->resize(points + kernels::point_padding);
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
  if (room_ != kernels::lists_room(points.size())) {
    room_ = kernels::lists_room(points.size());
    numbers_ = std::make_unique_for_overwrite<std::int32_t[]>(4 * room_);
  }
  merged_ = kernels::merge_windows(work.col_half.data(), work.row_half.data(), work.size_halves.data(),
                                   points.size(), table.shelf(), work.run_begin.data(),
                                   {.plane = numbers(0),
                                    .col = numbers(1),
                                    .row = numbers(2),
                                    .first_byte = numbers(3),
                                    .begin = list_begin_.data(),
                                    .end = list_end_.data()});
  lists_ = std::max(1, static_cast<int>(std::bit_width(static_cast<std::uint32_t>(merged_.weights))));
  // The kernel takes the highest bit first.
  std::reverse(list_begin_.begin(), list_begin_.begin() + lists_);
  std::reverse(list_end_.begin(), list_end_.begin() + lists_);
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
