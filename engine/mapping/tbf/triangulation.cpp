#include "engine/mapping/tbf/triangulation.hpp"

#include <cmath>

namespace landfall::internal {
namespace {

constexpr double gate_sigmas = 3.0;

// From the sonar to a point.
struct Sight {
  double distance_m;
  double x, y;  // unit vector
};

Sight sight_of(const SonarReading& reading, const Point2& p_map) {
  const double x = p_map.x_m - reading.arc.center_map.x_m;
  const double y = p_map.y_m - reading.arc.center_map.y_m;
  const double distance_m = std::sqrt(x * x + y * y);
  return {.distance_m = distance_m, .x = x / distance_m, .y = y / distance_m};
}

}  // namespace

Triangulation::Triangulation(const SonarReading& reading, const SonarReading& partner,
                             const Point2& crossing_map)
    : p_map_(crossing_map) {
  Point2 gradient;
  add(reading, gradient);
  add(partner, gradient);
  step(gradient);
}

bool Triangulation::agrees_with(const SonarReading& partner) const {
  const Sight sight = sight_of(partner, p_map_);
  const double off_m = partner.arc.radius_m - sight.distance_m;
  const double variance_m2 =
      partner.range_sigma_m * partner.range_sigma_m + covariance_m2_.quadratic(sight.x, sight.y);
  return off_m * off_m <= gate_sigmas * gate_sigmas * variance_m2;
}

void Triangulation::refine(const SonarReading& partner) {
  Point2 gradient;
  add(partner, gradient);
  step(gradient);
  ++triangulations_;
}

void Triangulation::add(const SonarReading& reading, Point2& gradient) {
  const Sight sight = sight_of(reading, p_map_);
  const double range_weight = 1.0 / (reading.range_sigma_m * reading.range_sigma_m);
  const double across_m = sight.distance_m * reading.bearing_sigma_rad;
  const double bearing_weight = 1.0 / (across_m * across_m);
  const double range_off_m = range_weight * (reading.arc.radius_m - sight.distance_m);
  const double bearing_off_m = bearing_weight * sight.distance_m * axis_offset_rad(reading.arc, p_map_);
  information_.add_outer(sight.x, sight.y, range_weight);
  information_.add_outer(-sight.y, sight.x, bearing_weight);
  gradient.x_m += range_off_m * sight.x - bearing_off_m * sight.y;
  gradient.y_m += range_off_m * sight.y + bearing_off_m * sight.x;
}

void Triangulation::step(const Point2& gradient) {
  covariance_m2_ = inverse(information_);
  const Point2 move = covariance_m2_.times(gradient.x_m, gradient.y_m);
  p_map_ = {.x_m = p_map_.x_m + move.x_m, .y_m = p_map_.y_m + move.y_m};
}

}  // namespace landfall::internal
