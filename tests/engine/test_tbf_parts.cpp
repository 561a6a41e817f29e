#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <set>
#include <vector>

#include "engine/base/counter_rng.hpp"
#include "engine/mapping/tbf/arc.hpp"
#include "engine/mapping/tbf/ellipse_cells.hpp"
#include "engine/mapping/tbf/reading_window.hpp"
#include "engine/mapping/tbf/triangulation.hpp"
#include "engine/mapping/tbf/triangulation_grid.hpp"
#include "sonar_drive.hpp"

namespace landfall::internal {
namespace {

using testing::degree_rad;
using testing::lobe_rad;
constexpr double pi = std::numbers::pi;

Arc arc_at(double x_m, double y_m, double direction_deg, double radius_m, double half_angle_rad = lobe_rad) {
  return make_arc({x_m, y_m, direction_deg * degree_rad}, half_angle_rad, radius_m);
}

TEST(Arcs, CrossWhereBothSonarsSeeTheTarget) {
  // The target is at (1, 1), each sonar's axis on it.
  const auto crossing =
      intersect(arc_at(0.0, 0.0, 45.0, std::sqrt(2.0)), arc_at(2.0, 0.0, 135.0, std::sqrt(2.0)));
  ASSERT_TRUE(crossing);
  EXPECT_NEAR(crossing->x_m, 1.0, 1e-12);
  EXPECT_NEAR(crossing->y_m, 1.0, 1e-12);
  // 12 degrees off the axis is within the lobe, 13 is not.
  EXPECT_TRUE(intersect(arc_at(0.0, 0.0, 57.0, std::sqrt(2.0)), arc_at(2.0, 0.0, 135.0, std::sqrt(2.0))));
  EXPECT_FALSE(intersect(arc_at(0.0, 0.0, 58.0, std::sqrt(2.0)), arc_at(2.0, 0.0, 135.0, std::sqrt(2.0))));
  EXPECT_FALSE(intersect(arc_at(0.0, 0.0, 45.0, std::sqrt(2.0)), arc_at(2.0, 0.0, 148.0, std::sqrt(2.0))));
}

TEST(Arcs, CirclesApartInsideEachOtherOrOfOneCentreDoNotCross) {
  EXPECT_FALSE(intersect(arc_at(0.0, 0.0, 0.0, 0.9), arc_at(2.0, 0.0, 180.0, 0.9)));
  EXPECT_FALSE(intersect(arc_at(0.0, 0.0, 0.0, 3.0), arc_at(0.5, 0.0, 0.0, 1.0)));
  EXPECT_FALSE(intersect(arc_at(1.0, 1.0, 0.0, 2.0), arc_at(1.0, 1.0, 0.0, 2.0)));
  const auto touching = intersect(arc_at(0.0, 0.0, 0.0, 1.0), arc_at(2.0, 0.0, 180.0, 1.0));
  ASSERT_TRUE(touching);
  EXPECT_NEAR(touching->x_m, 1.0, 1e-12);
}

TEST(Arcs, OfTwoCrossingsTheOneNearerToTheAxesCounts) {
  // Circles about (0, 0) and (1, 0) of radius 1 cross at (0.5, +-sqrt(3)/2).
  const double wide_rad = 85.0 * degree_rad;
  const auto up = intersect(arc_at(0.0, 0.0, 10.0, 1.0, wide_rad), arc_at(1.0, 0.0, 175.0, 1.0, wide_rad));
  ASSERT_TRUE(up);
  EXPECT_NEAR(up->y_m, std::sqrt(3.0) / 2.0, 1e-12);
  const auto down = intersect(arc_at(0.0, 0.0, -10.0, 1.0, wide_rad), arc_at(1.0, 0.0, 185.0, 1.0, wide_rad));
  ASSERT_TRUE(down);
  EXPECT_NEAR(down->y_m, -std::sqrt(3.0) / 2.0, 1e-12);
}

// The crossings of b's circle with a's arc by walking along the arc, within b's lobe widened by `slack_rad`.
std::vector<Point2> walked_crossings(const Arc& a, const Arc& b, double slack_rad) {
  constexpr int steps = 2000;
  const double axis_rad = std::atan2(a.axis_y, a.axis_x);
  const double half_rad = a.half_angle_rad + slack_rad;
  const auto at = [&](double k) {
    const double angle_rad = axis_rad + half_rad * (2.0 * k / steps - 1.0);
    return Point2{a.center_map.x_m + a.radius_m * std::cos(angle_rad),
                  a.center_map.y_m + a.radius_m * std::sin(angle_rad)};
  };
  const auto beyond = [&](const Point2& p) {
    return std::hypot(p.x_m - b.center_map.x_m, p.y_m - b.center_map.y_m) > b.radius_m;
  };
  std::vector<Point2> found;
  for (int k = 0; k < steps; ++k) {
    if (beyond(at(k)) == beyond(at(k + 1))) continue;
    const Point2 p = at(k + 0.5);
    if (std::abs(axis_offset_rad(b, p)) <= b.half_angle_rad + slack_rad) found.push_back(p);
  }
  return found;
}

TEST(Arcs, RandomPairsAgreeWithAWalkAlongTheArc) {
  int crossings = 0;
  int misses = 0;
  for (std::uint32_t i = 0; i < 4000; ++i) {
    CounterRng rng(7, i);
    const auto random_arc = [&] {
      return arc_at(rng.uniform(), rng.uniform(), 90.0 * rng.uniform() + 45.0, 1.0 + rng.uniform(),
                    (5.0 + 35.0 * rng.uniform()) * degree_rad);
    };
    const Arc a = random_arc();
    const Arc b = random_arc();
    const auto crossing = intersect(a, b);
    constexpr double slack_rad = 2e-3;
    const std::vector<Point2> surely = walked_crossings(a, b, -slack_rad);
    const std::vector<Point2> maybe = walked_crossings(a, b, slack_rad);
    if (!surely.empty()) {
      ASSERT_TRUE(crossing) << "pair " << i;
      ++crossings;
    }
    if (maybe.empty()) {
      // A walk steps over circles that barely meet.
      const double d = std::hypot(a.center_map.x_m - b.center_map.x_m, a.center_map.y_m - b.center_map.y_m);
      const double gap_m =
          std::min(std::abs(a.radius_m + b.radius_m - d), std::abs(std::abs(a.radius_m - b.radius_m) - d));
      ASSERT_TRUE(!crossing || gap_m < 1e-3) << "pair " << i;
      ++misses;
    } else if (crossing) {
      double nearest_m = 1e9;
      for (const Point2& p : maybe)
        nearest_m = std::min(nearest_m, std::hypot(p.x_m - crossing->x_m, p.y_m - crossing->y_m));
      EXPECT_LT(nearest_m, 2e-3) << "pair " << i;
    }
  }
  EXPECT_GT(crossings, 200);
  EXPECT_GT(misses, 300);
}

// A reading of the sonar at this place of a target, noise and direction drawn from the model.
SonarReading model_reading(const Point2& sonar_map, const Point2& target_map, CounterRng& rng) {
  const double x = target_map.x_m - sonar_map.x_m;
  const double y = target_map.y_m - sonar_map.y_m;
  const double range_m = std::hypot(x, y);
  const double sigma_m = 0.01 * range_m + 0.01;
  const double bearing_rad = std::atan2(y, x) + lobe_rad * (2.0 * rng.uniform() - 1.0);
  // The lobe is open, so that no trial is lost: the model's errors alone are looked at.
  return {.arc = make_arc({sonar_map.x_m, sonar_map.y_m, bearing_rad}, 1.5, range_m + sigma_m * rng.normal()),
          .range_sigma_m = sigma_m,
          .bearing_sigma_rad = lobe_rad / std::numbers::sqrt3};
}

// Mean of P_T, and the scatter of T about the truth, over trials with sonars at these places.
std::array<Symmetric2, 2> told_and_seen(const std::vector<Point2>& sonars_map, std::uint64_t seed) {
  const Point2 target_map{0.2, 1.5};
  Symmetric2 told;
  Symmetric2 seen;
  int trials = 0;
  for (std::uint32_t i = 0; i < 40000; ++i) {
    CounterRng rng(seed, i);
    std::vector<SonarReading> readings;
    readings.reserve(sonars_map.size());
    for (const Point2& sonar_map : sonars_map) readings.push_back(model_reading(sonar_map, target_map, rng));
    const auto crossing = intersect(readings[0].arc, readings[1].arc);
    if (!crossing) continue;
    Triangulation point(readings[0], readings[1], *crossing);
    for (std::size_t k = 2; k < readings.size(); ++k) point.refine(readings[k]);
    told.xx += point.covariance_m2().xx;
    told.xy += point.covariance_m2().xy;
    told.yy += point.covariance_m2().yy;
    seen.add_outer(point.p_map().x_m - target_map.x_m, point.p_map().y_m - target_map.y_m, 1.0);
    ++trials;
  }
  EXPECT_GT(trials, 39000);
  for (Symmetric2* sum : {&told, &seen}) *sum = {sum->xx / trials, sum->xy / trials, sum->yy / trials};
  return {told, seen};
}

void expect_alike(const Symmetric2& told, const Symmetric2& seen, double share) {
  EXPECT_NEAR(told.xx, seen.xx, share * seen.xx);
  EXPECT_NEAR(told.yy, seen.yy, share * seen.yy);
  EXPECT_NEAR(told.xy, seen.xy, share * std::sqrt(seen.xx * seen.yy));
}

TEST(Triangulations, CovarianceIsTheScatterOfTwoReadings) {
  const auto [told, seen] = told_and_seen({{-0.5, 0.0}, {0.6, 0.1}}, 11);
  expect_alike(told, seen, 0.05);
}

TEST(Triangulations, CovarianceIsTheScatterOfManyReadings) {
  const auto [told, seen] =
      told_and_seen({{-0.4, 0.0}, {0.6, 0.1}, {0.2, -0.3}, {0.9, 0.4}, {-0.2, 0.1}}, 12);
  expect_alike(told, seen, 0.05);
}

TEST(Triangulations, MorePartnersKnowThePointBetter) {
  const auto two = told_and_seen({{-0.5, 0.0}, {0.6, 0.1}}, 13)[1];
  const auto four = told_and_seen({{-0.5, 0.0}, {0.6, 0.1}, {-0.4, 0.0}, {0.7, 0.1}}, 13)[1];
  EXPECT_LT(spectral_radius(four), 0.7 * spectral_radius(two));
}

TEST(Triangulations, SpectralRadiusIsTheLargestEigenvalue) {
  EXPECT_NEAR(spectral_radius({.xx = 4.0, .xy = 0.0, .yy = 9.0}), 9.0, 1e-12);
  EXPECT_NEAR(spectral_radius({.xx = 2.0, .xy = 1.0, .yy = 2.0}), 3.0, 1e-12);
}

GridMap blank_grid(int width, int height, double resolution_m) {
  return {.width_cells = width,
          .height_cells = height,
          .resolution_m = resolution_m,
          .T_map_grid = {-1.0, -0.5, 0.0},
          .cells = std::vector<Occupancy>(static_cast<std::size_t>(width) * static_cast<std::size_t>(height),
                                          Occupancy::unknown)};
}

TEST(Ellipses, CellsAreThoseWithinThreeSigma) {
  const GridMap grid = blank_grid(60, 50, 0.05);
  int cells_seen = 0;
  for (std::uint32_t i = 0; i < 200; ++i) {
    CounterRng rng(3, i);
    const Point2 p{-1.2 + 3.4 * rng.uniform(), -0.7 + 2.9 * rng.uniform()};
    const double a = 0.005 + 0.1 * rng.uniform();
    const double b = 0.005 + 0.1 * rng.uniform();
    const double turn = pi * rng.uniform();
    Symmetric2 covariance;
    covariance.add_outer(std::cos(turn), std::sin(turn), a * a);
    covariance.add_outer(-std::sin(turn), std::cos(turn), b * b);
    std::vector<CellDensity> cells;
    ellipse_cells(grid, p, covariance, cells);
    // In the ellipse's own axes; a cell adds its variance to both.
    const double wide_a = std::sqrt(a * a + 0.05 * 0.05 / 12.0);
    const double wide_b = std::sqrt(b * b + 0.05 * 0.05 / 12.0);
    std::size_t next = 0;
    for (int row = 0; row < grid.height_cells; ++row)
      for (int col = 0; col < grid.width_cells; ++col) {
        const Point2 centre = grid.center_of({.col = col, .row = row});
        const double x = centre.x_m - p.x_m;
        const double y = centre.y_m - p.y_m;
        const double u = (x * std::cos(turn) + y * std::sin(turn)) / wide_a;
        const double v = (-x * std::sin(turn) + y * std::cos(turn)) / wide_b;
        if (u * u + v * v > 9.0) continue;
        ASSERT_LT(next, cells.size());
        EXPECT_EQ(cells[next].index, grid.index({.col = col, .row = row}));
        EXPECT_NEAR(
            cells[next].density,
            std::exp(-0.5 * (u * u + v * v)) / std::sqrt(2.0 * pi * wide_a * wide_a * wide_b * wide_b),
            1e-6 * cells[next].density);
        ++next;
      }
    EXPECT_EQ(next, cells.size());
    cells_seen += static_cast<int>(next);
  }
  EXPECT_GT(cells_seen, 5000);
}

// Sonars at (0, 0) and (1, 0) that both see (0.5, 0.5); sure enough for any test of deviation.
Triangulation sure_point() {
  const auto reading = [](double x_m, double direction_deg) {
    return SonarReading{.arc = arc_at(x_m, 0.0, direction_deg, std::sqrt(0.5)),
                        .range_sigma_m = 0.01,
                        .bearing_sigma_rad = 0.1};
  };
  return {reading(0.0, 45.0), reading(1.0, 135.0), {0.5, 0.5}};
}

TEST(TriangulationGrids, WriteEquationFive) {
  const TbfOptions options{.resolution_m = 0.1, .scale_m2 = 1e-5, .occupied_value = 0.01};
  const GridMap grid = blank_grid(30, 20, 0.1);
  TriangulationGrid written(grid, options);
  const Triangulation point = sure_point();
  const SonarReading from_left{
      .arc = arc_at(-0.5, 0.45, 0.0, 1.0), .range_sigma_m = 0.02, .bearing_sigma_rad = 0.1};
  written.add(point, from_left);
  std::vector<CellDensity> ellipse;
  ellipse_cells(grid, point.p_map(), point.covariance_m2(), ellipse);
  std::set<std::size_t> within;
  for (const CellDensity& cell : ellipse) {
    within.insert(cell.index);
    EXPECT_FLOAT_EQ(written.values()[cell.index], static_cast<float>(1e-5 * cell.density));
  }
  ASSERT_GE(within.size(), 4U);
  // The same point once more changes nothing; a second that is left of it halves what lies on its line.
  const std::vector<float> once = written.values();
  written.add(point, from_left);
  EXPECT_EQ(written.values(), once);
  Triangulation twice = point;
  twice.refine(from_left);
  EXPECT_EQ(twice.triangulations(), 2);
}

TEST(TriangulationGrids, HalveTheLineToTheReadingButNotTheEllipse) {
  const TbfOptions options{.resolution_m = 0.1, .scale_m2 = 1.0};  // every cell of an ellipse is cut at 1
  const GridMap grid = blank_grid(30, 20, 0.1);
  TriangulationGrid written(grid, options);
  const Triangulation point = sure_point();
  const SonarReading reading{
      .arc = arc_at(-0.45, 0.45, 0.0, 0.9), .range_sigma_m = 0.02, .bearing_sigma_rad = 0.1};
  written.add(point, reading);
  const std::size_t at_point = grid.index(grid.cell_of(point.p_map()));
  EXPECT_EQ(written.values()[at_point], 1.0f);
  // Seen through from the right: a point on the same height, left of it, from a sonar on its right.
  const auto shifted = [](double x_m, double direction_deg) {
    return SonarReading{.arc = arc_at(x_m, 0.0, direction_deg, std::sqrt(0.5)),
                        .range_sigma_m = 0.01,
                        .bearing_sigma_rad = 0.1};
  };
  const Triangulation left{shifted(-1.0, 45.0), shifted(0.0, 135.0), {-0.5, 0.5}};
  const SonarReading from_right{
      .arc = arc_at(1.5, 0.5, 180.0, 2.0), .range_sigma_m = 0.03, .bearing_sigma_rad = 0.1};
  written.add(left, from_right);
  EXPECT_EQ(written.values()[at_point], 0.5f);
  written.add(left, from_right);
  EXPECT_EQ(written.values()[at_point], 0.25f);
  EXPECT_EQ(written.values()[grid.index(grid.cell_of(left.p_map()))], 1.0f);
}

TEST(TriangulationGrids, APointThatIsNotSureLeavesNoTrace) {
  const Triangulation point = sure_point();
  const double deviation_m = std::sqrt(spectral_radius(point.covariance_m2()));
  const SonarReading reading{
      .arc = arc_at(-0.5, 0.5, 0.0, 1.0), .range_sigma_m = 0.02, .bearing_sigma_rad = 0.1};
  for (const double limit_m : {deviation_m * 0.999, deviation_m * 1.001}) {
    TriangulationGrid written(blank_grid(30, 20, 0.1), {.resolution_m = 0.1, .max_deviation_m = limit_m});
    written.add(point, reading);
    const bool any =
        std::any_of(written.values().begin(), written.values().end(), [](float g) { return g > 0.0f; });
    EXPECT_EQ(any, limit_m > deviation_m);
  }
}

std::vector<SonarReading> reading_of(const Arc& arc) {
  return {{.arc = arc, .range_sigma_m = 0.02, .bearing_sigma_rad = 0.126}};
}

std::vector<SonarReading> reading_at(double x_m) {
  return reading_of(arc_at(x_m, 0.0, 90.0, 1.0));
}

TEST(ReadingWindows, OfOneScanHaveNoPast) {
  ReadingWindow window(1);
  window.push(reading_at(0.0));
  EXPECT_FALSE(window.triangulate(reading_at(0.1)[0]));
}

TEST(ReadingWindows, DiscardTheOldestScan) {
  for (const int scans : {2, 3, 4, 6}) {
    ReadingWindow window(scans);
    for (const double x_m : {0.0, 0.01, 0.02, 0.03, 0.04}) window.push(reading_at(x_m));
    const auto point = window.triangulate(reading_at(0.05)[0]);
    ASSERT_TRUE(point);
    EXPECT_EQ(point->triangulations(), std::min(scans - 1, 5));
  }
}

TEST(ReadingWindows, PartnersOfAnotherTargetAreNotTaken) {
  // Its arc crosses the new reading's at (0.2, 0.98), the end of the lobe; the point that six others agree on
  // is near (0, 1), for which its range is 20 cm too short.
  const Arc other = arc_at(1.0, 0.9, 174.3, 0.804);
  ASSERT_TRUE(intersect(reading_at(0.0)[0].arc, other));
  for (const bool with_other : {false, true}) {
    ReadingWindow window(10);
    if (with_other) window.push(reading_of(other));
    for (const double x_m : {-0.12, -0.1, -0.08, -0.06, -0.04, -0.02}) window.push(reading_at(x_m));
    const auto point = window.triangulate(reading_at(0.0)[0]);
    ASSERT_TRUE(point);
    EXPECT_EQ(point->triangulations(), 6);
    EXPECT_NEAR(point->p_map().y_m, 1.0, 0.01);
  }
  // Alone it is a partner like any other.
  ReadingWindow window(10);
  window.push(reading_of(other));
  EXPECT_TRUE(window.triangulate(reading_at(0.0)[0]));
}

}  // namespace
}  // namespace landfall::internal
