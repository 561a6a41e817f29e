// What methods share that move a pose freely instead of scoring a lattice: where they start, how they count,
// and how their answers come back to the lattice.
#pragma once

#include <vector>

#include "engine/methods/pso/occupied_bits.hpp"
#include "engine/query.hpp"

namespace landfall::internal {

// Poses around which such a method looks, each within reach: the middle of a prior that is no larger; else
// drawn from it, `density` of them for each part as large as the reach, so that few parts go without. At
// least one, at most most_centers.
struct CenterReach {
  double translation_m = 0.5;
  double rotation_rad = 0.87;
};
inline constexpr std::size_t most_centers = 1 << 16;
std::vector<Pose2> search_centers(const Query& query, const CenterReach& reach, double density);

// The number of the scan's end points that fall into occupied cells.
class MapFit {
 public:
  explicit MapFit(const Query& query);
  [[nodiscard]] std::int32_t at(const Pose2& T_map_robot) const;
  // Points counted.
  [[nodiscard]] std::int32_t valid() const { return static_cast<std::int32_t>(x_cells_.size()); }

 private:
  const GridMap& grid_;
  Pose2 T_grid_map_;
  const OccupiedBits& bits_;
  std::vector<float> x_cells_, y_cells_;
};

// Poses with the method's own scores, as candidates: beside each the best pose of the prior's lattice, scored
// by the field; those beside which the prior has none are dropped. At most `most`, the best own scores.
Proposal propose_free(const Query& query, std::vector<FreeCandidate> found, std::size_t most = 256);

}  // namespace landfall::internal
