// One level of grids: local grids laid over a global one at every pose of a set (Courcelle & Horn 1999,
// section 2).
#pragma once

#include <vector>

#include "engine/methods/grid/local_grid.hpp"
#include "engine/query.hpp"

namespace landfall::internal {

enum class LocalGrids : std::uint8_t { oriented, turned };

// So much less than the best score may a rival have, as a share of the perfect one without the robot's cells.
inline constexpr double grid_rival_share = 0.2;

struct GridLevel {
  const Query& query;                              // its clock and threads
  const Lattice& lattice;                          // whose cells are the level's
  const std::vector<SharedMask>& mask_of_heading;  // the poses; null: none
  const std::vector<std::int8_t>& global;          // as large as the lattice
  const LocalModel& model;                         // in cells of the level
  double rival_share = 0.0;                        // of a perfect score, see rivals
  std::size_t most_rivals = max_candidates;
  LocalGrids local_grids = LocalGrids::oriented;
};

struct LevelScores {
  std::vector<Candidate>
      rivals;  // poses that score rival_share less than the best one, or better; best first
  std::int64_t poses_scored = 0;
  bool cut_short = false;  // the time was up
};

// How much less than the best score a rival may have.
RivalMargin rival_margin(const GridLevel& level);

// The poses are scored heading by heading, side by side.
LevelScores score_level(const GridLevel& level);

}  // namespace landfall::internal
