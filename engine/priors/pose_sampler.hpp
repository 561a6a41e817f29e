// Poses drawn from a prior: a lattice pose of its support, moved within the lattice's step.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/base/counter_rng.hpp"
#include "engine/priors/domain.hpp"

namespace landfall::internal {

// Holds references to what it is made from. A domain without poses has no draws.
class PoseSampler {
 public:
  PoseSampler(const Lattice& lattice, const Domain& domain);

  struct Drawn {
    Pose2 T_map_robot{};
    std::size_t component = 0;  // of the prior, that it was drawn from
  };
  [[nodiscard]] Drawn draw_with_component(CounterRng& rng) const;
  [[nodiscard]] Pose2 draw(CounterRng& rng) const { return draw_with_component(rng).T_map_robot; }
  // Of the support, in square metres times radians.
  [[nodiscard]] double volume() const { return volume_; }
  // Half of the box and of the cone around all of it.
  [[nodiscard]] double half_extent_m() const { return half_extent_m_; }
  [[nodiscard]] double half_extent_rad() const { return half_extent_rad_; }
  // Components with poses, and half of the box around the cells of one.
  [[nodiscard]] std::size_t components() const { return components_.size(); }
  [[nodiscard]] double half_extent_m(std::size_t component) const {
    return components_[component].half_extent_m;
  }

 private:
  // A mask that headings share, with the number of cells before each of its words.
  struct CountedMask {
    const BlockMask* mask = nullptr;
    std::vector<std::int64_t> cells_before{};  // one more than words
  };
  // Headings of one component of the prior, each with the poses of those before it.
  struct Component {
    double weight_up_to = 0.0;  // its own included
    double half_extent_m = 0.0;
    const GaussianDensity* gaussian = nullptr;
    std::vector<int> headings{};
    std::vector<std::size_t> mask_of_heading{};
    std::vector<std::int64_t> poses_before{};  // one more than headings
  };

  void add(const DomainComponent& component);
  std::size_t counted(const BlockMask& mask);
  void measure(const Domain& domain);
  [[nodiscard]] double half_extent_of(const Component& component) const;
  [[nodiscard]] LatticePose lattice_pose(const Component& component, std::int64_t index) const;
  [[nodiscard]] Pose2 moved_within_step(const LatticePose& pose, CounterRng& rng) const;

  const Lattice& lattice_;
  std::vector<CountedMask> masks_;
  std::vector<Component> components_;
  double volume_ = 0.0;
  double half_extent_m_ = 0.0;
  double half_extent_rad_ = 0.0;
};

}  // namespace landfall::internal
