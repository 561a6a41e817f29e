#include "engine/evidence.hpp"

#include <algorithm>
#include <cmath>

namespace landfall::internal {

double evidence_nats(std::size_t points) {
  return 27.3 * std::pow(static_cast<double>(points), 0.25);
}

double elsewhere_weight(double share, double explained) {
  constexpr double even_sum = 1.4;
  constexpr double nats_per_sum = 30.0;
  constexpr double most_nats = 50.0;
  return std::exp(std::min(most_nats, nats_per_sum * (even_sum - share - explained)));
}

}  // namespace landfall::internal
