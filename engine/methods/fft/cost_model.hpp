// What correlation costs, by transforms and point by point: nanoseconds of one thread on the reference
// machine, measured by bench_fft (CostModel). Only their ratio decides.
#pragma once

#include <cmath>

namespace landfall::internal {

// One transform of a plane of reals, with its share of what is done beside it (drawing, product, maxima).
// Planes beyond the caches cost more.
inline double transform_ns(int rows, int cols) {
  constexpr double ns_per_real_and_level = 0.10;
  constexpr double cached_reals = 1 << 18;
  constexpr double beyond_caches = 1.6;
  const double reals = static_cast<double>(rows) * cols;
  return ns_per_real_and_level * reals * std::log2(reals) * (reals > cached_reals ? beyond_caches : 1.0);
}

// One block of 8 x 8 poses at one heading, point by point.
inline double direct_ns(double points) {
  constexpr double ns_per_block = 20.0;
  constexpr double ns_per_block_and_point = 2.5;
  return ns_per_block + ns_per_block_and_point * points;
}

}  // namespace landfall::internal
