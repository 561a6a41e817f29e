#include "engine/priors/pose_sampler.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numbers>

namespace landfall::internal {
namespace {

using kernels::block_cells;

// In [0, count).
std::int64_t below(std::int64_t count, CounterRng& rng) {
  return std::min(count - 1, static_cast<std::int64_t>(rng.uniform() * static_cast<double>(count)));
}

int nth_set_bit(std::uint64_t word, std::int64_t n) {
  for (; n > 0; --n) word &= word - 1;
  return std::countr_zero(word);
}

// The last entry that is not above the index.
std::size_t slot_of(const std::vector<std::int64_t>& before, std::int64_t index) {
  return static_cast<std::size_t>(std::upper_bound(before.begin(), before.end(), index) - before.begin()) - 1;
}

// The shortest cone that holds all headings; half of its angle.
double half_cone_rad(const std::vector<bool>& has_heading, double step_rad) {
  const auto count = static_cast<int>(has_heading.size());
  int longest_gap = 0;
  int gap = 0;
  for (int k = 0; k < 2 * count; ++k) {
    gap = has_heading[static_cast<std::size_t>(k % count)] ? 0 : gap + 1;
    longest_gap = std::max(longest_gap, gap);
  }
  return std::min(std::numbers::pi, 0.5 * step_rad * std::max(1, count - longest_gap));
}

// Rows and columns of cells, last one included.
struct CellBox {
  int col0 = std::numeric_limits<int>::max();
  int row0 = std::numeric_limits<int>::max();
  int col1 = std::numeric_limits<int>::min();
  int row1 = std::numeric_limits<int>::min();

  void add(int col, int row) {
    col0 = std::min(col0, col);
    row0 = std::min(row0, row);
    col1 = std::max(col1, col);
    row1 = std::max(row1, row);
  }
  void add(const BlockMask& mask) {
    for (std::size_t word = 0; word < mask.words.size(); ++word) {
      const auto block = static_cast<int>(word);
      for (std::uint64_t bits = mask.words[word]; bits != 0; bits &= bits - 1) {
        const int bit = std::countr_zero(bits);
        add((mask.first_col + block % mask.cols) * block_cells + bit % block_cells,
            (mask.first_row + block / mask.cols) * block_cells + bit / block_cells);
      }
    }
  }
};

}  // namespace

PoseSampler::PoseSampler(const Lattice& lattice, const Domain& domain) : lattice_(lattice) {
  for (const DomainComponent& component : domain.components) add(component);
  measure(domain);
}

void PoseSampler::add(const DomainComponent& from) {
  Component component{.weight_up_to = from.weight, .gaussian = from.gaussian ? &*from.gaussian : nullptr};
  if (!components_.empty()) component.weight_up_to += components_.back().weight_up_to;
  component.poses_before.push_back(0);
  for (std::size_t k = 0; k < from.mask_of_heading.size(); ++k) {
    if (from.mask_of_heading[k] == nullptr) continue;
    component.headings.push_back(static_cast<int>(k));
    component.mask_of_heading.push_back(counted(*from.mask_of_heading[k]));
    component.poses_before.push_back(component.poses_before.back() +
                                     masks_[component.mask_of_heading.back()].cells_before.back());
  }
  if (component.poses_before.back() == 0) return;
  component.half_extent_m = half_extent_of(component);
  components_.push_back(std::move(component));
}

double PoseSampler::half_extent_of(const Component& component) const {
  CellBox box;
  std::vector<std::size_t> masks = component.mask_of_heading;  // many headings share one
  std::sort(masks.begin(), masks.end());
  masks.erase(std::unique(masks.begin(), masks.end()), masks.end());
  for (const std::size_t mask : masks) box.add(*masks_[mask].mask);
  return 0.5 * lattice_.resolution_m *
         std::min(std::max(box.col1 - box.col0, box.row1 - box.row0) + lattice_.step_cells,
                  std::max(lattice_.width_cells, lattice_.height_cells));
}

std::size_t PoseSampler::counted(const BlockMask& mask) {
  for (std::size_t i = masks_.size(); i-- > 0;)
    if (masks_[i].mask == &mask) return i;
  CountedMask counted{.mask = &mask};
  counted.cells_before.reserve(mask.words.size() + 1);
  counted.cells_before.push_back(0);
  for (const std::uint64_t word : mask.words)
    counted.cells_before.push_back(counted.cells_before.back() + std::popcount(word));
  masks_.push_back(std::move(counted));
  return masks_.size() - 1;
}

void PoseSampler::measure(const Domain& domain) {
  // Of a step wider than the map only the map is searched.
  const double step_x_m = std::min(lattice_.step_cells, lattice_.width_cells) * lattice_.resolution_m;
  const double step_y_m = std::min(lattice_.step_cells, lattice_.height_cells) * lattice_.resolution_m;
  volume_ = static_cast<double>(domain.poses) * step_x_m * step_y_m * lattice_.heading_step_rad();
  int col0 = lattice_.width_cells;
  int row0 = lattice_.height_cells;
  int col1 = -1;
  int row1 = -1;
  std::vector<bool> has_heading;
  for (const SharedMask& mask : domain.mask_of_heading) {
    has_heading.push_back(mask != nullptr && !mask->words.empty());
    if (!has_heading.back()) continue;
    col0 = std::min(col0, mask->first_col * block_cells);
    row0 = std::min(row0, mask->first_row * block_cells);
    col1 = std::max(col1, (mask->first_col + mask->cols) * block_cells);
    row1 = std::max(row1, (mask->first_row + mask->rows) * block_cells);
  }
  half_extent_m_ = 0.5 * std::max({0, col1 - col0, row1 - row0}) * lattice_.resolution_m;
  half_extent_rad_ = half_cone_rad(has_heading, lattice_.heading_step_rad());
}

LatticePose PoseSampler::lattice_pose(const Component& component, std::int64_t index) const {
  const std::size_t heading = slot_of(component.poses_before, index);
  const CountedMask& counted = masks_[component.mask_of_heading[heading]];
  const std::int64_t cell = index - component.poses_before[heading];
  const std::size_t word = slot_of(counted.cells_before, cell);
  const BlockMask& mask = *counted.mask;
  const int bit = nth_set_bit(mask.words[word], cell - counted.cells_before[word]);
  const auto block = static_cast<int>(word);
  return {.heading = component.headings[heading],
          .row = (mask.first_row + block / mask.cols) * block_cells + bit / block_cells,
          .col = (mask.first_col + block % mask.cols) * block_cells + bit % block_cells};
}

Pose2 PoseSampler::moved_within_step(const LatticePose& pose, CounterRng& rng) const {
  // What falls off the map, as with steps wider than it, lands anywhere along it.
  const auto drawn = [&](int cell, int cells) {
    const double share = rng.uniform();
    const double at = cell + 0.5 + (share - 0.5) * lattice_.step_cells;
    return at >= 0.0 && at <= cells ? at : share * cells;
  };
  const double col = drawn(pose.col, lattice_.width_cells);
  const double row = drawn(pose.row, lattice_.height_cells);
  const double turned_rad = (rng.uniform() - 0.5) * lattice_.heading_step_rad();
  return lattice_.T_map_grid * Pose2{col * lattice_.resolution_m, row * lattice_.resolution_m,
                                     lattice_.heading_grid_rad(pose.heading) + turned_rad};
}

PoseSampler::Drawn PoseSampler::draw_with_component(CounterRng& rng) const {
  constexpr int most_rejections = 1000;  // of a Gaussian's support, its density takes one in seven
  const double weight = rng.uniform() * components_.back().weight_up_to;
  std::size_t chosen = 0;
  while (chosen + 1 < components_.size() && weight >= components_[chosen].weight_up_to) ++chosen;
  const Component& component = components_[chosen];
  LatticePose pose;
  for (int i = 0; i < most_rejections; ++i) {
    pose = lattice_pose(component, below(component.poses_before.back(), rng));
    if (component.gaussian == nullptr) break;
    if (rng.uniform() < std::exp(component.gaussian->log(lattice_.T_map_robot(pose)))) break;
  }
  return {.T_map_robot = moved_within_step(pose, rng), .component = chosen};
}

}  // namespace landfall::internal
