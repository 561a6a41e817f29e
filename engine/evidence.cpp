#include "engine/evidence.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace landfall::internal {
namespace {

constexpr std::size_t samples = 96;

// Allowed poses spread evenly over the domain: headings in turn, and every so many blocks of their mask.
std::vector<LatticePose> sample_poses(const Domain& domain) {
  using kernels::block_cells;
  std::vector<std::size_t> headings;
  for (std::size_t k = 0; k < domain.mask_of_heading.size(); ++k)
    if (domain.mask_of_heading[k] != nullptr) headings.push_back(k);
  std::vector<LatticePose> poses;
  for (std::size_t i = 0; i < samples && !headings.empty(); ++i) {
    const std::size_t heading = headings[i * headings.size() / samples];
    const BlockMask& mask = *domain.mask_of_heading[heading];
    // The golden ratio's multiples are spread evenly however many are taken.
    const double along = std::fmod(0.6180339887498949 * static_cast<double>(i + 1), 1.0);
    auto at = static_cast<std::size_t>(along * static_cast<double>(mask.words.size()));
    std::size_t looked = 0;
    while (looked < mask.words.size() && mask.words[at] == 0) {
      at = (at + 1) % mask.words.size();
      ++looked;
    }
    if (looked == mask.words.size()) continue;
    const int bit = std::countr_zero(mask.words[at]);
    const auto cols = static_cast<std::size_t>(mask.cols);
    poses.push_back({.heading = static_cast<std::int32_t>(heading),
                     .row = (mask.first_row + static_cast<int>(at / cols)) * block_cells + bit / block_cells,
                     .col = (mask.first_col + static_cast<int>(at % cols)) * block_cells + bit % block_cells});
  }
  return poses;
}

double share_at(const Query& query, const LatticePose& pose, HeadingCells& cells) {
  const GridMap& grid = query.map.grid();
  const std::uint8_t* field = query.map.field().data();
  cells_at_heading(query.points, query.lattice, pose.heading, cells);
  std::int32_t score = 0;
  for (std::size_t i = 0; i < cells.col.size(); ++i) {
    const CellIndex cell{pose.col + cells.col[i], pose.row + cells.row[i]};
    if (grid.contains(cell)) score += field[grid.index(cell)];
  }
  return share_of(score, query.points.size());
}

}  // namespace

double evidence_nats(std::size_t points) { return 12.8 * std::pow(static_cast<double>(points), 0.25); }

double chance_share(const Query& query) {
  const std::vector<LatticePose> poses = sample_poses(query.domain);
  if (poses.size() < 2) return 0.0;
  double sum = 0.0;
  double squares = 0.0;
  HeadingCells cells;
  for (const LatticePose& pose : poses) {
    const double share = share_at(query, pose, cells);
    sum += share;
    squares += share * share;
  }
  const double mean = sum / static_cast<double>(poses.size());
  const double spread = std::sqrt(std::max(0.0, squares / static_cast<double>(poses.size()) - mean * mean));
  const Lattice& lattice = query.lattice;
  const double step_m = lattice.resolution_m * lattice.step_cells;
  const double poses_per_mode =
      std::max(1.0, query.options.distinct_translation_m * query.options.distinct_translation_m / (step_m * step_m)) *
      std::max(1.0, query.options.distinct_rotation_rad / lattice.heading_step_rad());
  const double modes = std::max(1.0, static_cast<double>(query.domain.poses) / poses_per_mode);
  return std::min(1.0, mean + spread * std::sqrt(2.0 * std::log(modes)));
}

}  // namespace landfall::internal
