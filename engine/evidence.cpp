#include "engine/evidence.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace landfall::internal {
namespace {

constexpr double power = 6.5;  // times the fourth root: 24 for 180 echoes
constexpr double least_misfit = 0.05;

double fourth_root(std::size_t points) {
  return std::pow(static_cast<double>(points), 0.25);
}

}  // namespace

double log_evidence(double share, std::size_t points) {
  return -power * fourth_root(points) * std::log(least_misfit + std::max(0.0, 1.0 - share));
}

double evidence_slope(double share, std::size_t points) {
  return power * fourth_root(points) / (least_misfit + std::max(0.0, 1.0 - share));
}

double log_add(double a, double b) {
  if (a < b) std::swap(a, b);
  return std::isinf(b) ? a : a + std::log1p(std::exp(b - a));
}

RivalMargin rival_margin(std::size_t points) {
  constexpr double most_share = 0.22;
  if (points == 0) return {};
  const double perfect = 255.0 * static_cast<double>(points);
  return {.most_score = most_share / fourth_root(points) * perfect,
          .part_of_misfit = std::expm1(rival_nats / (power * fourth_root(points))),
          .misfit_at_score_0 = (1.0 + least_misfit) * perfect};
}

RivalMargin second_margin(std::size_t points) {
  constexpr double share = 0.25;
  return {.most_score = share * 255.0 * static_cast<double>(points)};
}

double elsewhere_weight(double share, double held_m2) {
  constexpr double even_share = 0.955;  // where 1 m2 is held
  constexpr double nats_per_share = 60.0;
  constexpr double power_of_held = 2.5;
  constexpr double most_nats = 50.0;
  return std::exp(
      std::min(most_nats, nats_per_share * (even_share - share) - power_of_held * std::log(held_m2)));
}

}  // namespace landfall::internal
