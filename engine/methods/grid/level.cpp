#include "engine/methods/grid/level.hpp"

#include <algorithm>
#include <atomic>
#include <utility>

#include "engine/base/parallel.hpp"
#include "engine/methods/grid/weight_runs.hpp"
#include "kernels/score_cells.hpp"

namespace landfall::internal {
namespace {

using kernels::block_cells;

struct CellBox {
  int first_col, first_row, last_col, last_row;
};

// Of the poses' blocks, on the map.
CellBox box_of(const GridLevel& level) {
  const Lattice& lattice = level.lattice;
  CellBox box{lattice.width_cells, lattice.height_cells, -1, -1};
  for (const SharedMask& mask : level.mask_of_heading) {
    if (mask == nullptr || mask->words.empty()) continue;
    box.first_col = std::min(box.first_col, mask->first_col * block_cells);
    box.first_row = std::min(box.first_row, mask->first_row * block_cells);
    box.last_col = std::max(box.last_col, (mask->first_col + mask->cols) * block_cells - 1);
    box.last_row = std::max(box.last_row, (mask->first_row + mask->rows) * block_cells - 1);
  }
  box.last_col = std::min(box.last_col, lattice.width_cells - 1);
  box.last_row = std::min(box.last_row, lattice.height_cells - 1);
  return box;
}

// The part of the global grid that local grids reach from a box of poses; unknown beyond the map.
class GlobalView {
 public:
  GlobalView(const std::vector<std::int8_t>& global, const Lattice& lattice, const CellBox& box, int reach)
      : first_col_(box.first_col - reach),
        first_row_(box.first_row - reach),
        stride_(box.last_col - box.first_col + 1 + 2 * reach + static_cast<int>(kernels::score_columns)),
        cells_(static_cast<std::size_t>(stride_) *
               static_cast<std::size_t>(box.last_row - box.first_row + 2 + 2 * reach)) {
    const int col0 = std::max(0, first_col_);
    const int col1 = std::min(lattice.width_cells, first_col_ + stride_);
    const int row1 = std::min(lattice.height_cells, box.last_row + reach + 1);
    for (int row = std::max(0, first_row_); row < row1; ++row)
      std::copy_n(global.begin() + std::int64_t{row} * lattice.width_cells + col0, std::max(0, col1 - col0),
                  cells_.begin() + index(row, col0));
  }

  [[nodiscard]] const std::int8_t* at(int row, int col) const { return cells_.data() + index(row, col); }
  [[nodiscard]] std::int32_t offset(CellIndex cell) const { return cell.row * stride_ + cell.col; }

 private:
  [[nodiscard]] std::ptrdiff_t index(int row, int col) const {
    return std::ptrdiff_t{row - first_row_} * stride_ + (col - first_col_);
  }
  int first_col_;
  int first_row_;
  int stride_;
  std::vector<std::int8_t> cells_;
};

struct LevelSearch {
  const GridLevel& level;
  CellBox box;
  GlobalView view;
  RivalMargin margin;
  LocalGrid unturned;  // of heading 0 of the grid's frame
};

// Those that a level hands on.
void keep_most(const LevelSearch& search, std::vector<Candidate>& found) {
  keep_rivals(found, search.margin);
  if (found.size() > search.level.most_rivals) found.resize(search.level.most_rivals);
}

// The poses of one heading after the other. One per thread at a time.
class HeadingScorer {
 public:
  explicit HeadingScorer(const LevelSearch& search) : search_(search), painter_(search.level.model) {}

  // Adds what may be a rival; false where the time was up.
  bool score(int heading, std::vector<Candidate>& found) {
    const BlockMask& allowed = *search_.level.mask_of_heading[static_cast<std::size_t>(heading)];
    lay_out(heading);
    for (int row = search_.box.first_row; row <= search_.box.last_row; ++row) {
      if (search_.level.query.out_of_time()) return false;
      score_row(heading, row, allowed, found);
    }
    return true;
  }

 private:
  void lay_out(int heading) {
    const double heading_rad = search_.level.lattice.heading_grid_rad(heading);
    if (search_.level.local_grids == LocalGrids::oriented)
      painter_.paint(heading_rad, grid_);
    else
      grid_ = turned_raster(search_.unturned, heading_rad);
    runs_.lay_out(grid_,
                  [this](CellIndex cell, std::int32_t /*weight*/) { return search_.view.offset(cell); });
  }

  // From block to block that has poses; as many columns at once as the kernel takes.
  void score_row(int heading, int row, const BlockMask& allowed, std::vector<Candidate>& found) {
    constexpr int blocks_at_once = static_cast<int>(kernels::score_columns) / block_cells;
    const int last = allowed.first_col + allowed.cols - 1;
    for (int block_col = allowed.first_col; block_col <= last;) {
      if (bits(allowed, block_col, row) == 0) {
        ++block_col;
        continue;
      }
      int end = std::min(block_col + blocks_at_once, last + 1);
      while (bits(allowed, end - 1, row) == 0) --end;
      score_blocks(heading, row, allowed, block_col, end, found);
      block_col = end;
    }
  }

  static std::uint64_t bits(const BlockMask& allowed, int block_col, int row) {
    return (allowed.at(block_col, row / block_cells) >> (row % block_cells * block_cells)) & 0xffU;
  }

  void score_blocks(int heading, int row, const BlockMask& allowed, int first_block, int end_block,
                    std::vector<Candidate>& found) {
    const int first_col = std::max(first_block * block_cells, search_.box.first_col);
    const int last_col = std::min(end_block * block_cells - 1, search_.box.last_col);
    const auto cols = static_cast<std::size_t>(last_col + 1 - first_col);
    scores_.resize(kernels::whole_columns(cols));
    kernels::score_cells(search_.view.at(row, first_col), runs_.runs(), cols, scores_.data());
    for (int col = first_col; col <= last_col; ++col)
      if (((bits(allowed, col / block_cells, row) >> (col % block_cells)) & 1U) != 0)
        keep({.pose = {.heading = heading, .row = row, .col = col},
              .score = scores_[static_cast<std::size_t>(col - first_col)]},
             found);
  }

  void keep(const Candidate& candidate, std::vector<Candidate>& found) {
    best_ = std::max(best_, candidate.score);
    if (candidate.score < lowest_rival(best_, search_.margin)) return;
    found.push_back(candidate);
    if (found.size() >= 2 * max_candidates) keep_rivals(found, search_.margin);
  }

  const LevelSearch& search_;
  LocalGridPainter painter_;
  LocalGrid grid_;
  WeightRuns runs_;
  std::vector<std::int32_t> scores_;
  std::int32_t best_ = 0;
};

LocalGrid unturned_of(const LocalModel& model) {
  LocalGrid unturned;
  LocalGridPainter(model).paint(0.0, unturned);
  return unturned;
}

// The robot's own cells tell no pose from another.
RivalMargin margin_of(const GridLevel& level, const LocalGrid& unturned) {
  const double robot =
      level.model.robot_radius_cells > 0.0
          ? static_cast<double>(level.model.arc_weight()) * static_cast<double>(level.model.cones.size())
          : 0.0;
  return {.most_score =
              level.rival_share * std::max(0.0, static_cast<double>(unturned.perfect_score) - robot)};
}

LevelSearch prepare(const GridLevel& level) {
  LocalGrid unturned = unturned_of(level.model);
  const CellBox box = box_of(level);
  // A cell that is turned is rounded once more.
  const int reach = level.model.reach_cells() * 3 / 2 + 1;
  const RivalMargin margin = margin_of(level, unturned);
  return {.level = level,
          .box = box,
          .view = GlobalView(level.global, level.lattice, box, reach),
          .margin = margin,
          .unturned = std::move(unturned)};
}

}  // namespace

RivalMargin rival_margin(const GridLevel& level) {
  return margin_of(level, unturned_of(level.model));
}

LevelScores score_level(const GridLevel& level) {
  std::vector<int> headings;
  for (int k = 0; k < level.lattice.headings; ++k)
    if (level.mask_of_heading[static_cast<std::size_t>(k)] != nullptr) headings.push_back(k);
  LevelScores result;
  if (headings.empty()) return result;
  const LevelSearch search = prepare(level);
  std::vector<std::vector<Candidate>> found(headings.size());
  std::atomic<bool> cut_short{false};
  std::atomic<std::int64_t> scored{0};
  const int threads = level.query.threads;
  const auto tasks =
      std::min<std::size_t>(headings.size(), static_cast<std::size_t>(4 * thread_count(threads)));
  parallel_for(tasks, threads, [&](std::size_t task) {
    HeadingScorer scorer(search);
    for (std::size_t i = task; i < headings.size(); i += tasks) {
      if (!scorer.score(headings[i], found[i])) cut_short = true;
      keep_most(search, found[i]);
      scored += level.mask_of_heading[static_cast<std::size_t>(headings[i])]->count();
    }
  });
  for (const std::vector<Candidate>& some : found)
    result.rivals.insert(result.rivals.end(), some.begin(), some.end());
  keep_most(search, result.rivals);
  result.poses_scored = scored;
  result.cut_short = cut_short;
  return result;
}

}  // namespace landfall::internal
