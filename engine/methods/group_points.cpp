#include "engine/methods/group_points.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

#include "kernels/point_windows.hpp"

namespace landfall::internal {

namespace {

// What a build needs meanwhile.
struct Workspace {
  std::vector<std::int32_t> col_half, row_half, size_halves;
  struct Merged {
    std::int32_t plane;
    std::int32_t col;
    std::int32_t row;
    std::uint32_t weight;
  };
  std::vector<Merged> merged;
};

}  // namespace

void GroupPoints::build(const EndPoints& points, const Lattice& lattice, const BoundTable& table, int first,
                        int last) {
  const double step_rad = lattice.heading_step_rad();
  const double center_rad = 0.5 * (first + last - 1) * step_rad;
  const double half_rad = 0.5 * (last - 1 - first) * step_rad;
  const std::size_t count = points.size();
  static thread_local Workspace work;
  work.col_half.resize(count);
  work.row_half.resize(count);
  work.size_halves.resize(count);
  kernels::point_windows(points.x_cells_by_beam.data(), points.y_cells_by_beam.data(), count,
                         {.cos_center = std::cos(center_rad),
                          .sin_center = std::sin(center_rad),
                          .sin_half = half_rad >= std::numbers::pi / 2.0 ? 1.0 : std::sin(half_rad),
                          .cos_half = std::cos(half_rad)},
                         {.width_cells = lattice.width_cells,
                          .height_cells = lattice.height_cells,
                          .block_cells = table.block_cells()},
                         work.col_half.data(), work.row_half.data(), work.size_halves.data());
  constexpr std::size_t heaviest = (std::size_t{1} << most_lists) - 1;
  std::array<std::int32_t, most_lists> points_of_list{};
  work.merged.clear();
  unbounded_ = 0;
  for (std::size_t i = 0; i < count;) {
    const std::size_t begin = i;
    const std::int32_t col_half = work.col_half[begin];
    const std::int32_t row_half = work.row_half[begin];
    const std::int32_t size = work.size_halves[begin];
    while (i < count && i - begin < heaviest && work.col_half[i] == col_half &&
           work.row_half[i] == row_half && work.size_halves[i] == size)
      ++i;
    if (size == 0) continue;
    const auto weight = static_cast<std::uint32_t>(i - begin);
    const int window = BoundTable::window_index(size);
    if (window < 0) {
      unbounded_ += static_cast<std::int32_t>(weight);
      continue;
    }
    work.merged.push_back({.plane = table.plane(window, row_half & 1, col_half & 1),
                           .col = (col_half >> 1) + BoundTable::pad_cols,
                           .row = (row_half >> 1) + BoundTable::pad_rows,
                           .weight = weight});
    for (std::uint32_t bits = weight; bits != 0; bits &= bits - 1)
      ++points_of_list[static_cast<std::size_t>(most_lists - 1 - std::countr_zero(bits))];
  }
  std::size_t first_list = 0;
  while (first_list + 1 < most_lists && points_of_list[first_list] == 0) ++first_list;
  lists_ = static_cast<int>(most_lists - first_list);
  std::int32_t at = 0;
  for (std::size_t list = first_list; list < most_lists; ++list) {
    list_begin_[list - first_list] = list_end_[list - first_list] = at;
    at += points_of_list[list];
  }
  const auto room = static_cast<std::size_t>(at) + kernels::point_padding;
  plane_.resize(room);
  col_.resize(room);
  row_.resize(room);
  for (const Workspace::Merged& point : work.merged)
    for (std::uint32_t bits = point.weight; bits != 0; bits &= bits - 1) {
      const auto list = static_cast<std::size_t>(lists_ - 1 - std::countr_zero(bits));
      const auto to = static_cast<std::size_t>(list_end_[list]++);
      plane_[to] = point.plane;
      col_[to] = point.col;
      row_[to] = point.row;
    }
}

kernels::BoundPoints GroupPoints::view() const {
  return {.plane = plane_.data(),
          .col = col_.data(),
          .row = row_.data(),
          .list_begin = list_begin_.data(),
          .list_end = list_end_.data(),
          .lists = lists_};
}

}  // namespace landfall::internal
