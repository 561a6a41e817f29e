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
  std::vector<std::uint32_t> run_begin;  // of equal windows side by side, and the end of the last
  std::vector<MergedPoint> merged;

  void resize(std::size_t points) {
    col_half.resize(points);
    row_half.resize(points);
    size_halves.resize(points);
    run_begin.resize(points + 1);
    merged.clear();
  }
};

// How many. No branch hangs on where a run ends, which cannot be foretold (bench_search).
std::size_t find_runs(Workspace& work) {
  const std::size_t points = work.col_half.size();
  const std::int32_t* col = work.col_half.data();
  const std::int32_t* row = work.row_half.data();
  const std::int32_t* size = work.size_halves.data();
  std::uint32_t* begin = work.run_begin.data();
  std::size_t runs = 1;
  begin[0] = 0;
  for (std::size_t i = 1; i < points; ++i) {
    begin[runs] = static_cast<std::uint32_t>(i);
    const std::int32_t differs = (col[i] ^ col[i - 1]) | (row[i] ^ row[i - 1]) | (size[i] ^ size[i - 1]);
    runs += differs != 0 ? 1 : 0;
  }
  begin[runs] = static_cast<std::uint32_t>(points);
  return runs;
}

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
  constexpr std::uint32_t heaviest = (1U << most_lists) - 1;
  unbounded_ = 0;
  const std::size_t runs = find_runs(work);
  for (std::size_t run = 0; run < runs; ++run) {
    const std::uint32_t begin = work.run_begin[run];
    std::uint32_t weight = work.run_begin[run + 1] - begin;
    const std::int32_t size = work.size_halves[begin];
    if (size == 0) continue;
    const int window = BoundTable::window_index(size);
    if (window < 0) {
      unbounded_ += static_cast<std::int32_t>(weight);
      continue;
    }
    MergedPoint point{.plane = table.plane(window, work.row_half[begin] & 1, work.col_half[begin] & 1),
                      .col = (work.col_half[begin] >> 1) + BoundTable::pad_cols,
                      .row = (work.row_half[begin] >> 1) + BoundTable::pad_rows,
                      .weight = weight};
    for (; weight > heaviest; weight -= heaviest) {
      point.weight = heaviest;
      work.merged.push_back(point);
    }
    point.weight = weight;
    work.merged.push_back(point);
  }
  fill_lists(work.merged, points.size());
}

void GroupPoints::fill_lists(const std::vector<MergedPoint>& merged, std::size_t points) {
  const std::size_t room = points + kernels::point_padding;  // a point of weight w stands in at most w lists
  plane_.resize(room);
  col_.resize(room);
  row_.resize(room);
  std::uint32_t all_bits = 1;  // one list at least
  for (const MergedPoint& point : merged) all_bits |= point.weight;
  lists_ = static_cast<int>(std::bit_width(all_bits));
  std::size_t at = 0;
  for (int list = 0; list < lists_; ++list) {
    const int bit = lists_ - 1 - list;
    list_begin_[static_cast<std::size_t>(list)] = static_cast<std::int32_t>(at);
    for (const MergedPoint& point : merged) {
      plane_[at] = point.plane;
      col_[at] = point.col;
      row_[at] = point.row;
      at += (point.weight >> bit) & 1U;
    }
    list_end_[static_cast<std::size_t>(list)] = static_cast<std::int32_t>(at);
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
