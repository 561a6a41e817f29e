#include "engine/methods/grid/reduced.hpp"

#include <algorithm>
#include <bit>
#include <map>

#include "engine/methods/grid/level.hpp"

namespace landfall::internal {
namespace {

using kernels::block_cells;

// Of the perfect score, below the best one; more where poses are more alike.
constexpr double handed_on_share = 0.25;
constexpr std::size_t most_handed_on = 4096;

struct Reduction {
  int factor = 1;          // a cell's side, in cells of the map
  int heading_stride = 1;  // in headings of the lattice
};

// From the finest, which is the lattice itself, to the coarsest.
std::vector<Reduction> reductions_of(const Lattice& lattice) {
  constexpr double slack = 1.0 + 1e-6;
  std::vector<Reduction> levels{{}};
  for (;;) {
    const Reduction& last = levels.back();
    const double cell_m = 2.0 * last.factor * lattice.resolution_m;
    if (cell_m > slack * largest_reduced_cell_m || 2 * last.factor > lattice.width_cells) return levels;
    const double step_rad = 2.0 * last.heading_stride * lattice.heading_step_rad();
    const bool thinner = step_rad <= slack * widest_reduced_heading_step_rad;
    levels.push_back({2 * last.factor, thinner ? 2 * last.heading_stride : last.heading_stride});
  }
}

Lattice reduced_lattice(const Lattice& lattice, int factor) {
  Lattice reduced = lattice;
  reduced.resolution_m *= factor;
  reduced.width_cells = (lattice.width_cells + factor - 1) / factor;
  reduced.height_cells = (lattice.height_cells + factor - 1) / factor;
  reduced.step_cells = 1;
  return reduced;
}

// The large cells that hold any cell of a mask.
void insert_reduced(const BlockMask& cells, int factor, BlockMask& reduced) {
  for (int block_row = cells.first_row; block_row < cells.first_row + cells.rows; ++block_row)
    for (int block_col = cells.first_col; block_col < cells.first_col + cells.cols; ++block_col) {
      for (std::uint64_t word = cells.at(block_col, block_row); word != 0; word &= word - 1) {
        const int bit = std::countr_zero(word);
        reduced.insert((block_col * block_cells + bit % block_cells) / factor,
                       (block_row * block_cells + bit / block_cells) / factor);
      }
    }
}

BlockMask empty_mask(const Lattice& lattice) {
  return make_block_mask(0, 0, lattice.width_cells - 1, lattice.height_cells - 1);
}

int wrapped(int heading, int headings) {
  return (heading % headings + headings) % headings;
}

// The poses of the coarsest level: every cell that holds one of the prior's, at headings of either side.
std::vector<SharedMask> coarsest_poses(const Query& query, const Lattice& lattice, const Reduction& level) {
  const int headings = lattice.headings;
  std::vector<SharedMask> masks(static_cast<std::size_t>(headings));
  std::map<std::vector<const BlockMask*>, SharedMask> known;  // most headings share theirs
  for (int k = 0; k < headings; k += level.heading_stride) {
    std::vector<const BlockMask*> parts;
    for (int j = 1 - level.heading_stride; j < level.heading_stride; ++j) {
      const SharedMask& part =
          query.domain.mask_of_heading[static_cast<std::size_t>(wrapped(k + j, headings))];
      if (part != nullptr && std::find(parts.begin(), parts.end(), part.get()) == parts.end())
        parts.push_back(part.get());
    }
    if (parts.empty()) continue;
    SharedMask& shared = known[parts];
    if (shared == nullptr) {
      BlockMask mask = empty_mask(lattice);
      for (const BlockMask* part : parts) insert_reduced(*part, level.factor, mask);
      mask.remember_count();
      shared = std::make_shared<const BlockMask>(std::move(mask));
    }
    masks[static_cast<std::size_t>(k)] = shared;
  }
  return masks;
}

// What the coarser level hands to the finer one: the cells within each pose's and those around them, at its
// heading and those between it and the next ones.
std::vector<SharedMask> handed_on(const Query& query, const std::vector<Candidate>& poses,
                                  const Reduction& coarse, const Reduction& fine, const Lattice& lattice) {
  std::vector<std::shared_ptr<BlockMask>> made(static_cast<std::size_t>(lattice.headings));
  const int turns = coarse.heading_stride / fine.heading_stride - 1;
  for (const Candidate& pose : poses) {
    for (int turn = -turns; turn <= turns; ++turn) {
      const int heading = wrapped(pose.pose.heading + turn * fine.heading_stride, lattice.headings);
      std::shared_ptr<BlockMask>& mask = made[static_cast<std::size_t>(heading)];
      if (mask == nullptr) mask = std::make_shared<BlockMask>(empty_mask(lattice));
      for (int row = std::max(0, 2 * pose.pose.row - 1); row <= 2 * pose.pose.row + 2; ++row)
        for (int col = std::max(0, 2 * pose.pose.col - 1); col <= 2 * pose.pose.col + 2; ++col)
          if (lattice.contains({.heading = heading, .row = row, .col = col})) mask->insert(col, row);
    }
  }
  std::vector<SharedMask> masks(made.size());
  for (std::size_t k = 0; k < made.size(); ++k) {
    if (made[k] == nullptr) continue;
    if (fine.factor == 1) {  // the prior's poses alone
      const SharedMask& prior = query.domain.mask_of_heading[k];
      if (prior == nullptr) continue;
      for (int row = 0; row < made[k]->rows; ++row)
        for (int col = 0; col < made[k]->cols; ++col)
          made[k]->words[static_cast<std::size_t>(row) * static_cast<std::size_t>(made[k]->cols) +
                         static_cast<std::size_t>(col)] &= prior->at(col, row);
    }
    made[k]->remember_count();
    masks[k] = std::move(made[k]);
  }
  return masks;
}

}  // namespace

GridMap draw_reduced(const GridMap& map, int factor) {
  GridMap reduced{.width_cells = (map.width_cells + factor - 1) / factor,
                  .height_cells = (map.height_cells + factor - 1) / factor,
                  .resolution_m = map.resolution_m * factor,
                  .T_map_grid = map.T_map_grid,
                  .cells = {}};
  reduced.cells.assign(
      static_cast<std::size_t>(reduced.width_cells) * static_cast<std::size_t>(reduced.height_cells),
      Occupancy::unknown);
  for (int row = 0; row < map.height_cells; ++row)
    for (int col = 0; col < map.width_cells; ++col) {
      const Occupancy cell = map.cells[map.index({.col = col, .row = row})];
      Occupancy& drawn = reduced.cells[reduced.index({.col = col / factor, .row = row / factor})];
      if (cell == Occupancy::occupied || (cell == Occupancy::free && drawn == Occupancy::unknown))
        drawn = cell;
    }
  return reduced;
}

Proposal propose_by_reduction(const Query& query) {
  Proposal proposal;
  proposal.scores = Scores::own;
  const std::vector<Reduction> levels = reductions_of(query.lattice);
  std::vector<SharedMask> masks;
  for (std::size_t left = levels.size(); left-- > 0;) {
    const Reduction& level = levels[left];
    const Lattice lattice = left == 0 ? query.lattice : reduced_lattice(query.lattice, level.factor);
    if (left + 1 == levels.size())
      masks = left == 0 ? query.domain.mask_of_heading : coarsest_poses(query, lattice, level);
    else
      masks = handed_on(query, proposal.candidates, levels[left + 1], level, lattice);
    const LocalModel model =
        make_local_model(query.scan, lattice, query.options.robot_radius_m, level.factor);
    const LevelScores scores = score_level({.query = query,
                                            .lattice = lattice,
                                            .mask_of_heading = masks,
                                            .global = query.map.reduced_grid(level.factor),
                                            .model = model,
                                            .rival_share = left == 0 ? grid_rival_share : handed_on_share,
                                            .most_rivals = left == 0 ? max_candidates : most_handed_on});
    proposal.candidates = scores.rivals;
    proposal.counts.poses_scored += scores.poses_scored;
    if (scores.cut_short) {
      if (left > 0) proposal.candidates.clear();  // no poses of the lattice yet
      break;
    }
  }
  return proposal;
}

}  // namespace landfall::internal
