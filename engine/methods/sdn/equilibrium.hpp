// When a network has settled.
#pragma once

#include <cstddef>
#include <deque>

namespace landfall::internal {

// Beattie & Bishop 2.2: equilibrium is reached where z, the number of cells in the largest cluster, stays
// within a - b and a + b for a number of iterations, with 2 b < cells, a + b <= cells, a - b >= 0. Here a is
// the mean of z over these iterations; it must be a share of the cells, which keeps out the trivial case of
// clusters that come and go.
struct EquilibriumOptions {
  std::size_t cells = 0;
  int iterations = 6;
  double least_share = 0.08;  // of the cells: a
  double least_cells = 24.0;  // a too: the mean of few is rough;
  double few_share = 0.25;    // but of few cells no more than this share is asked for
  double bound_share = 0.2;   // of the cells: b
};

class Equilibrium {
 public:
  explicit Equilibrium(const EquilibriumOptions& options) : options_(options) {}

  // Of the next iteration; true where the network has settled.
  bool add(std::size_t cells_in_largest_cluster);

 private:
  EquilibriumOptions options_;
  std::deque<double> latest_;
};

}  // namespace landfall::internal
