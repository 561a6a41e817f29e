#include "engine/methods/group_points.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

namespace landfall::internal {
namespace {

struct Offsets {
  int least;
  int most;
};

// All cell offsets that `center` can have while it moves by up to `side` sideways and towards 0 (and
// beyond, where cos_half is negative) by the arc's sagitta.
Offsets offsets_over(double center, double side, double cos_half) {
  constexpr double rounding = 1e-6;  // far above double's error at a million cells
  const double inner = center * cos_half;
  return {static_cast<int>(std::floor(0.5 + std::min(center, inner) - side - rounding)),
          static_cast<int>(std::floor(0.5 + std::max(center, inner) + side + rounding))};
}

int floor_divide(int a, int b) {
  return a >= 0 ? a / b : -((b - 1 - a) / b);
}

}  // namespace

void GroupPoints::merge(std::int32_t plane, std::int32_t col, std::int32_t row) {
  const auto key = static_cast<std::uint32_t>(plane) * 2654435761U ^
                   static_cast<std::uint32_t>(col) * 40503U ^ static_cast<std::uint32_t>(row) * 2246822519U;
  const std::size_t mask = slots_.size() - 1;
  for (std::size_t at = (key ^ key >> 15U) & mask;; at = (at + 1) & mask) {
    const std::int32_t i = slots_[at];
    if (i < 0) {
      slots_[at] = static_cast<std::int32_t>(merged_.size());
      merged_.push_back({plane, col, row, 1});
      return;
    }
    Merged& known = merged_[static_cast<std::size_t>(i)];
    if (known.plane == plane && known.col == col && known.row == row) {
      ++known.weight;
      return;
    }
  }
}

void GroupPoints::make_lists() {
  std::int32_t heaviest = 1;
  for (const Merged& point : merged_) heaviest = std::max(heaviest, point.weight);
  plane_.clear();
  col_.clear();
  row_.clear();
  list_end_.clear();
  for (int bit = std::bit_width(static_cast<std::uint32_t>(heaviest)) - 1; bit >= 0; --bit) {
    for (const Merged& point : merged_) {
      if (((point.weight >> bit) & 1) == 0) continue;
      plane_.push_back(point.plane);
      col_.push_back(point.col);
      row_.push_back(point.row);
    }
    list_end_.push_back(static_cast<std::int32_t>(plane_.size()));
  }
  scratch_.resize(merged_.size() + 16);
}

void GroupPoints::build(const EndPoints& points, const Lattice& lattice, const BoundTable& table, int first,
                        int last) {
  const double step_rad = lattice.heading_step_rad();
  const double center_rad = 0.5 * (first + last - 1) * step_rad;
  const double half_rad = 0.5 * (last - 1 - first) * step_rad;
  const double c = std::cos(center_rad);
  const double s = std::sin(center_rad);
  // Beyond a quarter turn every direction is met.
  const double sin_half = half_rad >= std::numbers::pi / 2.0 ? 1.0 : std::sin(half_rad);
  const double cos_half = std::cos(half_rad);
  const int block = table.block_cells();
  const int half = table.half_cells();
  merged_.clear();
  slots_.assign(std::bit_ceil(2 * points.size() + 2), -1);
  unbounded_ = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double x = c * points.x_cells[i] - s * points.y_cells[i];
    const double y = s * points.x_cells[i] + c * points.y_cells[i];
    const Offsets cols = offsets_over(x, std::abs(y) * sin_half, cos_half);
    const Offsets rows = offsets_over(y, std::abs(x) * sin_half, cos_half);
    if (cols.least >= lattice.width_cells || cols.most <= -lattice.width_cells ||
        rows.least >= lattice.height_cells || rows.most <= -lattice.height_cells)
      continue;  // off the map from every cell of it
    const int col = floor_divide(cols.least, half);
    const int row = floor_divide(rows.least, half);
    const int wide = (block + cols.most - col * half + half - 1) / half;
    const int tall = (block + rows.most - row * half + half - 1) / half;
    const int window = BoundTable::window_index(std::max(wide, tall));
    if (window < 0) {
      ++unbounded_;
      continue;
    }
    const int phase_col = col & 1;
    const int phase_row = row & 1;
    merge(table.plane(window, phase_row, phase_col), (col - phase_col) / 2 + BoundTable::pad_cols,
          (row - phase_row) / 2 + BoundTable::pad_rows);
  }
  make_lists();
}

kernels::BoundPoints GroupPoints::view() const {
  return {.plane = plane_.data(),
          .col = col_.data(),
          .row = row_.data(),
          .list_end = list_end_.data(),
          .lists = static_cast<std::int32_t>(list_end_.size())};
}

}  // namespace landfall::internal
