#include "engine/methods/sdn/equilibrium.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace landfall::internal {

bool Equilibrium::add(std::size_t cells_in_largest_cluster) {
  const auto cells = static_cast<double>(options_.cells);
  const auto iterations = static_cast<std::size_t>(options_.iterations);
  latest_.push_back(static_cast<double>(cells_in_largest_cluster));
  if (latest_.size() > iterations) latest_.pop_front();
  if (latest_.size() < iterations) return false;
  const double a = std::accumulate(latest_.begin(), latest_.end(), 0.0) / static_cast<double>(iterations);
  const double b = std::min(options_.bound_share * cells, a);
  const double enough = std::min(options_.least_cells, options_.few_share * cells);
  if (a < std::max(enough, options_.least_share * cells)) return false;
  return std::all_of(latest_.begin(), latest_.end(), [&](double z) { return std::abs(z - a) <= b; });
}

}  // namespace landfall::internal
