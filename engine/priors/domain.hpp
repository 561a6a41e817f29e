// A prior on the lattice: which poses may be scored, and how much each weighs.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "engine/priors/block_mask.hpp"
#include "engine/priors/gaussian_density.hpp"
#include "engine/priors/lattice.hpp"
#include "landfall/prior.hpp"

namespace landfall::internal {

// One part of the prior (a plain prior has one). Headings without poses have a null mask.
struct DomainComponent {
  std::vector<SharedMask> mask_of_heading;
  double weight = 1.0;                      // normalised over the components
  double normaliser = 0.0;                  // sum of the density over the component's poses
  std::optional<GaussianDensity> gaussian;  // else the density is 1
};

struct Domain {
  std::vector<SharedMask> mask_of_heading;  // union of the components'
  std::vector<DomainComponent> components;  // those with weight and free poses
  std::int64_t poses = 0;                   // lattice poses, after the free-space mask
  bool on_map = false;                      // the prior's support touches the map, free or not

  [[nodiscard]] bool contains(const LatticePose& pose) const;
  // Prior probability of a pose of the domain, natural logarithm. Over the domain they sum to 1.
  [[nodiscard]] double log_prior(const Lattice& lattice, const LatticePose& pose) const;
};

// `free` holds the possible cells of the whole map (on the lattice's step).
Domain make_domain(const PosePrior& prior, const Lattice& lattice, const SharedMask& free);

}  // namespace landfall::internal
