// What correlation costs, by transforms and point by point: nanoseconds of one thread on the reference
// machine, measured by bench_fft (CostModel). Only their ratio decides.
#pragma once

#include <cmath>

#include "engine/methods/fft/real_fft.hpp"

namespace landfall::internal {

// One transform of a plane of reals, with its share of what is done beside it (drawing, product, maxima).
// Planes beyond the caches cost more.
inline double transform_ns(int rows, int cols) {
  constexpr double cached_reals = 1 << 18;
  constexpr double much_larger_reals = 1 << 23;
  const TransformCost cost = RealFft::cost();
  const double reals = static_cast<double>(rows) * cols;
  double slower = 1.0;
  if (reals > cached_reals) slower = cost.beyond_caches;
  if (reals > much_larger_reals) slower = cost.far_beyond_caches;
  return slower * cost.ns_per_real_and_level * reals * std::log2(reals);
}

// One block of 8 x 8 poses at one heading, point by point.
inline double direct_ns(double points) {
  constexpr double ns_per_block = 20.0;
  constexpr double ns_per_block_and_point = 0.7;
  return ns_per_block + ns_per_block_and_point * points;
}

}  // namespace landfall::internal
