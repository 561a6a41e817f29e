#include "engine/align/surfaces.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>

namespace landfall::internal {
namespace {

// Closer points repeat each other: the near end of a wall would outvote all the rest.
constexpr double thinned_m = 0.03;
constexpr std::size_t most_points = 2000;

// A line takes in this many echoes on either side, and more within this distance.
constexpr int least_on_a_side = 3;
constexpr double line_reach_m = 0.3;
// Spread across a line over spread along it, squared.
constexpr double roundest_line = 0.1;

// Neighbouring echoes lie on one surface where the gap between them is small, or at most twice the gap
// before it: gaps grow evenly along a wall seen at a grazing angle.
constexpr double gap_growth = 2.0;
double small_gap_m(double range_m) {
  return 0.1 + 0.03 * range_m;
}
double widest_first_gap_m(double range_m) {
  return 0.1 * range_m;
}

double distance(const Point2& a, const Point2& b) {
  const double dx = a.x_m - b.x_m;
  const double dy = a.y_m - b.y_m;
  return std::sqrt(dx * dx + dy * dy);  // metres: no need of hypot, a third of SLAM's time (bench/RESULTS.md)
}

// Sums over points, relative to the first one.
struct Scatter {
  Point2 origin;
  double count = 0.0, x = 0.0, y = 0.0, xx = 0.0, xy = 0.0, yy = 0.0;

  void add(const Point2& p) {
    const double dx = p.x_m - origin.x_m;
    const double dy = p.y_m - origin.y_m;
    count += 1.0;
    x += dx;
    y += dy;
    xx += dx * dx;
    xy += dx * dy;
    yy += dy * dy;
  }

  // The normal of the line through the points; none where they do not form one.
  [[nodiscard]] std::optional<Point2> normal() const {
    if (count < 3.0) return std::nullopt;
    const double cov_xx = xx / count - x * x / (count * count);
    const double cov_xy = xy / count - x * y / (count * count);
    const double cov_yy = yy / count - y * y / (count * count);
    const double half_trace = 0.5 * (cov_xx + cov_yy);
    const double root = std::hypot(0.5 * (cov_xx - cov_yy), cov_xy);
    if (half_trace - root > roundest_line * (half_trace + root)) return std::nullopt;
    const double along_rad = 0.5 * std::atan2(2.0 * cov_xy, cov_xx - cov_yy);
    return Point2{.x_m = -std::sin(along_rad), .y_m = std::cos(along_rad)};
  }
};

// Takes in the surface from echo i onwards, in steps of `direction`.
void add_side(std::span<const Echo> echoes, std::size_t i, int direction, double widest_gap_m,
              Scatter& sums) {
  const auto count = static_cast<std::ptrdiff_t>(echoes.size());
  int taken = 0;
  for (auto k = static_cast<std::ptrdiff_t>(i) + direction; k >= 0 && k < count; k += direction) {
    const Point2& p = echoes[static_cast<std::size_t>(k)].p_end;
    const double gap_m = distance(p, echoes[static_cast<std::size_t>(k - direction)].p_end);
    if (gap_m > widest_gap_m) return;
    if (taken >= least_on_a_side && distance(p, echoes[i].p_end) > line_reach_m) return;
    sums.add(p);
    ++taken;
    widest_gap_m = std::max(small_gap_m(echoes[i].range_m), gap_growth * gap_m);
  }
}

std::optional<Point2> normal_at(std::span<const Echo> echoes, std::size_t i) {
  const Echo& echo = echoes[i];
  if (!echo.ray) return std::nullopt;
  double nearest_m = widest_first_gap_m(echo.range_m);
  if (i > 0) nearest_m = std::min(nearest_m, distance(echo.p_end, echoes[i - 1].p_end));
  if (i + 1 < echoes.size()) nearest_m = std::min(nearest_m, distance(echo.p_end, echoes[i + 1].p_end));
  const double widest_gap_m = std::max(small_gap_m(echo.range_m), gap_growth * nearest_m);
  Scatter sums{.origin = echo.p_end};
  sums.add(echo.p_end);
  add_side(echoes, i, -1, widest_gap_m, sums);
  add_side(echoes, i, +1, widest_gap_m, sums);
  std::optional<Point2> normal = sums.normal();
  if (!normal) return std::nullopt;
  const double away =
      normal->x_m * (echo.p_end.x_m - echo.p_origin.x_m) + normal->y_m * (echo.p_end.y_m - echo.p_origin.y_m);
  if (away > 0.0) normal = Point2{.x_m = -normal->x_m, .y_m = -normal->y_m};
  return normal;
}

}  // namespace

std::vector<Echo> echoes_within(const Scan& scan, double distance_m) {
  std::vector<Echo> echoes;
  for (std::size_t b = 0; b < scan.ranges_m.size(); ++b) {
    const Beam& beam = scan.sensor->beams[b];
    if (classify(beam, scan.ranges_m[b]) != Reading::echo) continue;
    const double range_m = scan.ranges_m[b];
    const Point2 p_origin{.x_m = beam.T_robot_beam.x_m, .y_m = beam.T_robot_beam.y_m};
    const Point2 p_end = beam.T_robot_beam * Point2{.x_m = range_m, .y_m = 0.0};
    if (std::max(distance(p_origin, {}), distance(p_end, {})) > distance_m) continue;
    echoes.push_back(
        {.p_origin = p_origin, .p_end = p_end, .range_m = range_m, .ray = beam.half_angle_rad == 0.0});
  }
  return echoes;
}

std::vector<SurfacePoint> surface_points(std::span<const Echo> echoes) {
  std::vector<SurfacePoint> points;
  const std::size_t stride = 1 + echoes.size() / most_points;
  for (std::size_t i = 0; i < echoes.size(); i += stride) {
    const Point2& p = echoes[i].p_end;
    if (!points.empty() && distance(p, points.back().p) < thinned_m) continue;
    const std::optional<Point2> normal = normal_at(echoes, i);
    points.push_back({.p = p, .normal = normal.value_or(Point2{}), .has_normal = normal.has_value()});
  }
  return points;
}

}  // namespace landfall::internal
