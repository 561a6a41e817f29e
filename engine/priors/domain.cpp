#include "engine/priors/domain.hpp"

#include <cmath>
#include <numeric>

#include "engine/priors/support.hpp"

namespace landfall::internal {
namespace {

// Neighbouring headings mostly share their masks; so do the unions.
void add_masks(const std::vector<SharedMask>& added, std::vector<SharedMask>& masks) {
  SharedMask last_added;
  SharedMask last_before;
  SharedMask last_union;
  for (std::size_t k = 0; k < masks.size(); ++k) {
    if (added[k] == nullptr || added[k] == masks[k]) continue;
    if (masks[k] == nullptr) {
      masks[k] = added[k];
      continue;
    }
    if (added[k] != last_added || masks[k] != last_before) {
      last_added = added[k];
      last_before = masks[k];
      last_union = std::make_shared<const BlockMask>(merged(*masks[k], *added[k]));
    }
    masks[k] = last_union;
  }
}

// The plain priors of a mixture, with their share of the weight.
void flatten(const PosePrior& prior, double weight, std::vector<std::pair<const PosePrior*, double>>& plain) {
  const auto* mixture = std::get_if<Mixture>(&prior.kind);
  if (mixture == nullptr) {
    plain.emplace_back(&prior, weight);
    return;
  }
  const double total = std::accumulate(mixture->weights.begin(), mixture->weights.end(), 0.0);
  for (std::size_t i = 0; i < mixture->components.size(); ++i)
    flatten(mixture->components[i], weight * mixture->weights[i] / total, plain);
}

}  // namespace

bool Domain::contains(const LatticePose& pose) const {
  const SharedMask& mask = mask_of_heading[static_cast<std::size_t>(pose.heading)];
  return mask != nullptr && mask->contains(pose.col, pose.row);
}

double Domain::log_prior(const Lattice& lattice, const LatticePose& pose) const {
  double density = 0.0;
  for (const DomainComponent& component : components) {
    const SharedMask& mask = component.mask_of_heading[static_cast<std::size_t>(pose.heading)];
    if (mask == nullptr || !mask->contains(pose.col, pose.row)) continue;
    const double one =
        component.gaussian ? std::exp(component.gaussian->log(lattice.T_map_robot(pose))) : 1.0;
    density += component.weight * one / component.normaliser;
  }
  return std::log(density);
}

Domain make_domain(const PosePrior& prior, const Lattice& lattice, const SharedMask& free) {
  std::vector<std::pair<const PosePrior*, double>> plain;
  flatten(prior, 1.0, plain);
  Domain domain;
  domain.mask_of_heading.resize(static_cast<std::size_t>(lattice.headings));
  double total = 0.0;
  for (const auto& [part, weight] : plain) {
    DomainComponent component = make_support(*part, lattice, free, domain.on_map);
    if (!(component.normaliser > 0.0) || weight <= 0.0) continue;
    component.weight = weight;
    total += weight;
    add_masks(component.mask_of_heading, domain.mask_of_heading);
    domain.components.push_back(std::move(component));
  }
  for (DomainComponent& component : domain.components) component.weight /= total;
  domain.poses = count_poses(domain.mask_of_heading);
  return domain;
}

}  // namespace landfall::internal
