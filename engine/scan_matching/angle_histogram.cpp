#include "engine/scan_matching/angle_histogram.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "engine/base/rigid.hpp"

namespace landfall::internal {
namespace {

constexpr double least_line_m = 0.25;
constexpr double longest_line_m = 0.5;  // farther echoes lie on different surfaces
constexpr std::size_t least_points = 10;

using Histogram = std::vector<double>;

// The directions of lines, modulo half a turn, weighted by length.
Histogram angle_histogram(std::span<const Point2> points, std::size_t bins) {
  Histogram histogram(bins, 0.0);
  std::size_t first = 0;
  for (std::size_t i = 1; i < points.size(); ++i) {
    const double dx = points[i].x_m - points[first].x_m;
    const double dy = points[i].y_m - points[first].y_m;
    const double length_m = std::hypot(dx, dy);
    if (length_m < least_line_m) continue;
    if (length_m <= longest_line_m) {
      const double share = std::atan2(dy, dx) / std::numbers::pi + 1.0;  // 0 to 2
      histogram[static_cast<std::size_t>((share - std::floor(share)) * static_cast<double>(bins)) % bins] +=
          length_m;
      ++first;  // lines overlap: each echo begins one
      i = first;
    } else {
      first = i;
    }
  }
  return histogram;
}

// A line's angle is off by noise: neighbouring bins stand for each other.
Histogram smoothed(const Histogram& histogram, std::ptrdiff_t radius) {
  const auto bins = static_cast<std::ptrdiff_t>(histogram.size());
  Histogram smooth(histogram.size(), 0.0);
  for (std::ptrdiff_t i = 0; i < bins; ++i)
    for (std::ptrdiff_t d = -radius; d <= radius; ++d)
      smooth[static_cast<std::size_t>(i)] += static_cast<double>(radius + 1 - std::abs(d)) *
                                             histogram[static_cast<std::size_t>((i + d + bins) % bins)];
  return smooth;
}

// The shift of `after` by whole bins, from -reach to reach, that agrees best with `before`; the smaller of
// equals. Round histograms wrap.
std::ptrdiff_t best_shift(const Histogram& before, const Histogram& after, std::ptrdiff_t center,
                          std::ptrdiff_t reach, bool round) {
  const auto bins = static_cast<std::ptrdiff_t>(before.size());
  std::ptrdiff_t best = center;
  double most = -1.0;
  for (std::ptrdiff_t k = 0; k <= 2 * reach; ++k) {
    const std::ptrdiff_t shift = center + (k % 2 == 0 ? k / 2 : -(k + 1) / 2);
    double sum = 0.0;
    for (std::ptrdiff_t i = 0; i < bins; ++i) {
      std::ptrdiff_t to = i + shift;
      if (round) to = ((to % bins) + bins) % bins;
      if (to >= 0 && to < bins)
        sum += after[static_cast<std::size_t>(i)] * before[static_cast<std::size_t>(to)];
    }
    if (sum > most) {
      most = sum;
      best = shift;
    }
  }
  return best;
}

// Of one coordinate, from -half_bins to half_bins.
template <class Coordinate>
Histogram coordinate_histogram(std::span<const Point2> points, const Rigid& to_axes, std::ptrdiff_t half_bins,
                               double bin_m, const Coordinate& coordinate) {
  Histogram histogram(static_cast<std::size_t>(2 * half_bins + 1), 0.0);
  for (const Point2& p : points) {
    const auto bin =
        static_cast<std::ptrdiff_t>(std::floor(coordinate(to_axes.point(p)) / bin_m)) + half_bins;
    if (bin >= 0 && bin < static_cast<std::ptrdiff_t>(histogram.size()))
      histogram[static_cast<std::size_t>(bin)] += 1.0;
  }
  return histogram;
}

double farthest(std::span<const Point2> points) {
  double most = 0.0;
  for (const Point2& p : points) most = std::max(most, std::hypot(p.x_m, p.y_m));
  return most;
}

}  // namespace

Pose2 match_histograms(std::span<const Point2> before, std::span<const Point2> after,
                       const Pose2& T_before_start, const HistogramOptions& options) {
  if (before.size() < least_points || after.size() < least_points) return T_before_start;
  const auto bins = static_cast<std::size_t>(std::ceil(std::numbers::pi / options.bin_rad));
  const double bin_rad = std::numbers::pi / static_cast<double>(bins);
  const Histogram angles_before = smoothed(angle_histogram(before, bins), 2);
  const Histogram angles_after = smoothed(angle_histogram(after, bins), 2);
  const std::ptrdiff_t start = std::lround(T_before_start.theta_rad / bin_rad);
  const double turn_rad =
      bin_rad * static_cast<double>(best_shift(angles_before, angles_after, start,
                                               std::lround(options.reach_rad / bin_rad), true));

  // Both with their most frequent direction along x.
  const auto most = std::max_element(angles_before.begin(), angles_before.end()) - angles_before.begin();
  const double main_rad = bin_rad * (static_cast<double>(most) + 0.5);
  const Rigid before_axes(Pose2{.x_m = 0.0, .y_m = 0.0, .theta_rad = -main_rad});
  const Rigid after_axes(Pose2{.x_m = 0.0, .y_m = 0.0, .theta_rad = turn_rad - main_rad});
  const Point2 start_axes = before_axes.direction({.x_m = T_before_start.x_m, .y_m = T_before_start.y_m});
  const double half_m = std::max(farthest(before), farthest(after)) + options.reach_m;
  const auto half_bins = static_cast<std::ptrdiff_t>(std::ceil(half_m / options.bin_m));
  const auto reach = static_cast<std::ptrdiff_t>(std::lround(options.reach_m / options.bin_m));
  const auto shift_m = [&](double start_m, const auto& coordinate) {
    return options.bin_m *
           static_cast<double>(
               best_shift(coordinate_histogram(before, before_axes, half_bins, options.bin_m, coordinate),
                          coordinate_histogram(after, after_axes, half_bins, options.bin_m, coordinate),
                          std::lround(start_m / options.bin_m), reach, false));
  };
  const Point2 shift_axes{.x_m = shift_m(start_axes.x_m, [](const Point2& p) { return p.x_m; }),
                          .y_m = shift_m(start_axes.y_m, [](const Point2& p) { return p.y_m; })};
  const Point2 shift = Rigid(Pose2{.x_m = 0.0, .y_m = 0.0, .theta_rad = main_rad}).direction(shift_axes);
  return {.x_m = shift.x_m, .y_m = shift.y_m, .theta_rad = wrap_angle(turn_rad)};
}

}  // namespace landfall::internal
