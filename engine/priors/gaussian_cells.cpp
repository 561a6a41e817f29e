#include "engine/priors/gaussian_cells.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace landfall::internal {

using kernels::block_cells;

Pose2 GaussianCells::T_map_robot(int col, int row, double theta_map_rad) const {
  const double x_m = (col + 0.5) * lattice_.resolution_m;
  const double y_m = (row + 0.5) * lattice_.resolution_m;
  return {.x_m = lattice_.T_map_grid.x_m + cos_grid_ * x_m - sin_grid_ * y_m,
          .y_m = lattice_.T_map_grid.y_m + sin_grid_ * x_m + cos_grid_ * y_m,
          .theta_rad = theta_map_rad};
}

double GaussianCells::insert(double theta_map_rad, BlockMask& mask) {
  if (box_.empty()) return 0.0;
  const int step = lattice_.step_cells;
  const Pose2 T_grid_mean = inverse(lattice_.T_map_grid) * density_.T_map_mean();
  // Parabolas are taken from the column beside the mean: nothing large cancels there.
  const int nearest_col = static_cast<int>(
      std::clamp(T_grid_mean.x_m / lattice_.resolution_m, double(box_.col0), double(box_.col1)));
  double sum = 0.0;
  for (int row = next_multiple(box_.row0, step); row <= box_.row1; row += step) {
    const GaussianDensity::Line line =
        density_.along(T_map_robot(nearest_col, row, theta_map_rad), cos_grid_ * lattice_.resolution_m,
                       sin_grid_ * lattice_.resolution_m);
    const Span span = span_of(row, theta_map_rad, nearest_col, line);
    if (next_multiple(span.first, step) > span.last) continue;
    any_ = true;
    sum += insert_span(span, row, nearest_col, line, mask);
  }
  return sum;
}

// Where the parabola says, and at the ends as the density itself says.
GaussianCells::Span GaussianCells::span_of(int row, double theta_map_rad, int nearest_col,
                                           const GaussianDensity::Line& line) const {
  constexpr double uncertainty = 1e-6;
  const bool flat = line.curve > -std::numeric_limits<double>::min();  // wider than numbers tell
  if (flat && line.at0 >= least_log_) return {.first = box_.col0, .last = box_.col1};
  const double peak = -0.5 * line.slope / line.curve;
  const double above = line.log(peak) - least_log_;
  if (!(above > -uncertainty * (1.0 + std::abs(line.at0)))) return {.first = 0, .last = -1};
  const double half = std::sqrt(std::max(above, 0.0) / -line.curve);
  const auto column = [&](double off) {
    return static_cast<int>(std::clamp(nearest_col + off, box_.col0 - 1.0, box_.col1 + 1.0));
  };
  Span span{.first = std::max(box_.col0, column(peak - half - 1.0)),
            .last = std::min(box_.col1, column(peak + half + 1.0) + 1)};
  const auto inside = [&](int col) {
    return density_.log(T_map_robot(col, row, theta_map_rad)) >= least_log_;
  };
  while (span.first <= span.last && !inside(span.first)) ++span.first;
  while (span.first < span.last && !inside(span.last)) --span.last;
  return span;
}

// A block of the free cells at a time. Products begin anew every few blocks: rounding does not pile up.
double GaussianCells::insert_span(const Span& span, int row, int nearest_col,
                                  const GaussianDensity::Line& line, BlockMask& mask) const {
  constexpr int blocks_per_start = 8;
  const int block_row = row / block_cells;
  const int shift = row % block_cells * block_cells;
  const double shrink = std::exp(2.0 * line.curve);
  double sum = 0.0;
  double value = 0.0;
  double ratio = 0.0;
  bool start = true;
  for (int block = span.first / block_cells; block <= span.last / block_cells; ++block) {
    const int first = std::max(span.first, block * block_cells);
    const int last = std::min(span.last, block * block_cells + block_cells - 1);
    if (start || block % blocks_per_start == 0) {
      const double k = first - nearest_col;
      value = std::exp(line.log(k));
      ratio = std::exp(line.slope + line.curve * (2.0 * k + 1.0));
      start = false;
    }
    const std::uint64_t in_span =
        (std::uint64_t{2} << (last % block_cells)) - (std::uint64_t{1} << (first % block_cells));
    const std::uint64_t cells = free_.at(block, block_row) >> shift & in_span;
    mask.insert_block(block, block_row, cells << shift);
    for (int col = first; col <= last; ++col) {
      if (cells >> (col % block_cells) & 1U) sum += value;
      value *= ratio;
      ratio *= shrink;
    }
  }
  return sum;
}

}  // namespace landfall::internal
