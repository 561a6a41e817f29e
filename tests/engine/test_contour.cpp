// Metres of contour that hold a pose: of rooms, corridors and walls that end points are laid on by hand.
#include "engine/verify/contour.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace landfall::internal {
namespace {

constexpr double start_m = 0.2;  // in each direction, of no contour at all

// Echoes along the straight line from a to b, seen from the origin, `step_m` apart.
void add_wall(std::vector<EchoRay>& echoes, const Point2& a, const Point2& b, double step_m) {
  const double length_m = std::hypot(b.x_m - a.x_m, b.y_m - a.y_m);
  const int steps = static_cast<int>(std::lround(length_m / step_m));
  for (int i = 0; i <= steps; ++i) {
    const double at = static_cast<double>(i) / steps;
    echoes.push_back(
        {.origin_robot = {},
         .end_robot = {.x_m = a.x_m + at * (b.x_m - a.x_m), .y_m = a.y_m + at * (b.y_m - a.y_m)}});
  }
}

std::vector<EchoRay> wall(const Point2& a, const Point2& b, double step_m) {
  std::vector<EchoRay> echoes;
  add_wall(echoes, a, b, step_m);
  return echoes;
}

// Three sides of a square of 4 m around the origin.
std::vector<EchoRay> alcove(double step_m) {
  std::vector<EchoRay> echoes;
  add_wall(echoes, {-2.0, -2.0}, {2.0, -2.0}, step_m);
  add_wall(echoes, {2.0, -2.0}, {2.0, 2.0}, step_m);
  add_wall(echoes, {2.0, 2.0}, {-2.0, 2.0}, step_m);
  return echoes;
}

double held(const std::vector<EchoRay>& echoes, bool explained = true) {
  return held_m2(find_contour(echoes), std::vector<bool>(echoes.size(), explained));
}

TEST(Contour, NothingHoldsNothing) {
  EXPECT_DOUBLE_EQ(held({}), start_m * start_m);
  EXPECT_DOUBLE_EQ(held(alcove(0.05), false), start_m * start_m);
}

TEST(Contour, AStraightWallHoldsOneDirectionAlone) {
  EXPECT_NEAR(held(wall({-2.0, 1.0}, {2.0, 1.0}, 0.1)), (4.0 + start_m) * start_m, 0.17);
  const double c = std::cos(0.6);
  const double s = std::sin(0.6);
  EXPECT_NEAR(held(wall({-2.0 * c, -2.0 * s}, {2.0 * c, 2.0 * s}, 0.1)), (4.0 + start_m) * start_m, 0.17);
}

TEST(Contour, WallsAtAnAngleHoldBoth) {
  EXPECT_NEAR(held(alcove(0.1)), (8.0 + start_m) * (4.0 + start_m), 6.0);  // corners and their squares
}

TEST(Contour, MetresCountAndNotEchoes) {
  const double sparse = held(alcove(0.4));
  for (const double step_m : {0.2, 0.1, 0.02, 0.005}) EXPECT_NEAR(held(alcove(step_m)), sparse, 0.2 * sparse);
}

TEST(Contour, NoiseIsNoWallAcross) {
  std::vector<EchoRay> echoes = wall({-2.0, 1.0}, {2.0, 1.0}, 0.01);
  for (std::size_t i = 0; i < echoes.size(); ++i) echoes[i].end_robot.y_m += i % 2 == 0 ? 0.02 : -0.02;
  EXPECT_LT(held(echoes), 1.5 * (4.0 + start_m) * start_m);
}

TEST(Contour, WhatIsSeenTwiceCountsOnce) {
  std::vector<EchoRay> twice = alcove(0.1);
  const double once = held(twice);
  const std::vector<EchoRay> again = alcove(0.13);
  twice.insert(twice.end(), again.begin(), again.end());
  EXPECT_NEAR(held(twice), once, 0.25 * once);  // by far not four times as much
}

TEST(Contour, WallsFarApartAreNotJoined) {
  std::vector<EchoRay> echoes = wall({1.0, -1.0}, {1.0, 0.0}, 0.1);
  add_wall(echoes, {5.0, 0.0}, {5.0, 1.0}, 0.1);  // 4 m behind its end
  EXPECT_NEAR(held(echoes), (2.0 + start_m) * start_m, 0.1);
}

// As those of a ring of sonars: each says how far something is along its beam.
TEST(Contour, EchoesFarApartHoldALittleEach) {
  std::vector<EchoRay> echoes;
  for (int i = 0; i < 8; ++i) {
    const double bearing_rad = i * std::numbers::pi / 4.0;
    echoes.push_back({.origin_robot = {},
                      .end_robot = {.x_m = 3.0 * std::cos(bearing_rad), .y_m = 3.0 * std::sin(bearing_rad)}});
  }
  EXPECT_NEAR(held(echoes), (0.4 + start_m) * (0.4 + start_m), 1e-9);
}

TEST(Contour, PiecesCountByTheirExplainedEchoes) {
  const std::vector<EchoRay> echoes = wall({-2.0, 1.0}, {2.0, 1.0}, 0.1);
  const std::vector<ContourPiece> pieces = find_contour(echoes);
  std::vector<bool> half(echoes.size(), false);
  for (std::size_t i = 0; i < echoes.size() / 2; ++i) half[i] = true;
  EXPECT_NEAR(held_m2(pieces, half), (2.0 + start_m) * start_m, 0.1);
}

}  // namespace
}  // namespace landfall::internal
