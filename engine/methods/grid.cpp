// Occupancy-grid matching: Courcelle & Horn 1999, "Static localization of a wheelchair". A local occupancy
// grid made from one scan is laid over the global grid at every pose of the prior; the largest sum of
// products wins.
//
// Beyond the paper: beams without half-angle are rays (lasers), poses are those of any prior, sums are
// integers (an arc weighs 2^14 instead of 1), and all poses near the best score are answered, not it alone.
#include <algorithm>
#include <atomic>
#include <cmath>
#include <optional>

#include "engine/methods/grid/local_grid.hpp"
#include "engine/methods/table.hpp"
#include "engine/parallel.hpp"
#include "kernels/score_cells.hpp"

namespace landfall::internal {
namespace {

using kernels::block_cells;

// So much less than the best score may a rival have, as a share of the perfect one.
constexpr double rival_share = 0.2;
// Memory of a local grid ends here: 100 m in cells of 5 cm.
constexpr double farthest_local_cells = 2000.0;

struct CellBox {
  int first_col, first_row, last_col, last_row;
};

// Of the prior's blocks, on the map.
CellBox box_of(const Domain& domain, const Lattice& lattice) {
  CellBox box{lattice.width_cells, lattice.height_cells, -1, -1};
  for (const SharedMask& mask : domain.mask_of_heading) {
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

struct GridSearch {
  const Query& query;
  const LocalModel& model;
  const GlobalView& view;
  CellBox box;
  RivalMargin margin;
  const LocalGrid* turned = nullptr;  // of heading 0 of the grid's frame: local grids are this one, turned
};

// The poses of one heading after the other. One per thread at a time.
class HeadingScorer {
 public:
  explicit HeadingScorer(const GridSearch& search) : search_(search), painter_(search.model) {}

  // Adds what may be a rival; false where the time was up.
  bool score(int heading, std::vector<Candidate>& found) {
    const BlockMask& allowed = *search_.query.domain.mask_of_heading[static_cast<std::size_t>(heading)];
    lay_out(heading);
    for (int row = search_.box.first_row; row <= search_.box.last_row; ++row) {
      if (search_.query.out_of_time()) return false;
      score_row(heading, row, allowed, found);
    }
    return true;
  }

 private:
  void lay_out(int heading) {
    const double heading_rad = search_.query.lattice.heading_grid_rad(heading);
    if (search_.turned == nullptr)
      painter_.paint(heading_rad, grid_);
    else
      grid_ = turned_raster(*search_.turned, heading_rad);
    offsets_.clear();
    run_end_.clear();
    run_weight_.clear();
    for (std::size_t i = 0; i < grid_.cells.size(); ++i) {
      if (i == 0 || grid_.weights[i] != grid_.weights[i - 1]) {
        run_weight_.push_back(grid_.weights[i]);
        run_end_.push_back(0);
      }
      offsets_.push_back(search_.view.offset(grid_.cells[i]));
      run_end_.back() = static_cast<std::int32_t>(offsets_.size());
    }
  }

  void score_row(int heading, int row, const BlockMask& allowed, std::vector<Candidate>& found) {
    const int block_row = row / block_cells;
    const auto bits = [&](int block_col) {
      return (allowed.at(block_col, block_row) >> (row % block_cells * block_cells)) & 0xffU;
    };
    int first = allowed.first_col;
    int last = allowed.first_col + allowed.cols - 1;
    while (first <= last && bits(first) == 0) ++first;
    while (first <= last && bits(last) == 0) --last;
    if (first > last) return;
    const int first_col = std::max(first * block_cells, search_.box.first_col);
    const int last_col = std::min(last * block_cells + block_cells - 1, search_.box.last_col);
    const std::size_t cols = static_cast<std::size_t>(last_col) + 1 - static_cast<std::size_t>(first_col);
    scores_.resize(kernels::whole_columns(cols));
    kernels::score_cells(search_.view.at(row, first_col),
                         {.offset = offsets_.data(),
                          .run_end = run_end_.data(),
                          .run_weight = run_weight_.data(),
                          .runs = run_end_.size()},
                         cols, scores_.data());
    for (int col = first_col; col <= last_col; ++col)
      if (((bits(col / block_cells) >> (col % block_cells)) & 1U) != 0)
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

  const GridSearch& search_;
  LocalGridPainter painter_;
  LocalGrid grid_;
  std::vector<std::int32_t> offsets_, run_end_, run_weight_, scores_;
  std::int32_t best_ = 0;
};

LocalModel make_model(const Query& query) {
  const Lattice& lattice = query.lattice;
  const double farthest =
      std::min(farthest_local_cells, std::hypot(lattice.width_cells, lattice.height_cells) + 1.0);
  return {.cones = make_cones(query.scan, lattice.resolution_m, farthest),
          .robot_radius_cells = std::min(farthest, query.options.robot_radius_m / lattice.resolution_m)};
}

enum class LocalGrids : std::uint8_t { oriented, turned };

Proposal propose(const Query& query, Contours contours, LocalGrids local_grids) {
  Proposal proposal;
  const LocalModel model = make_model(query);
  LocalGrid unturned;
  LocalGridPainter(model).paint(0.0, unturned);
  const double perfect = static_cast<double>(unturned.perfect_score);
  const CellBox box = box_of(query.domain, query.lattice);
  // A cell that is turned is rounded once more.
  const GlobalView view(query.map.global_grid(contours), query.lattice, box, model.reach_cells() * 3 / 2 + 1);
  const GridSearch search{.query = query,
                          .model = model,
                          .view = view,
                          .box = box,
                          .margin = {.most_score = rival_share * perfect},
                          .turned = local_grids == LocalGrids::turned ? &unturned : nullptr};
  std::vector<int> headings;
  for (int k = 0; k < query.lattice.headings; ++k)
    if (query.domain.mask_of_heading[static_cast<std::size_t>(k)] != nullptr) headings.push_back(k);
  std::vector<std::vector<Candidate>> found(headings.size());
  std::atomic<bool> cut_short{false};
  std::atomic<std::int64_t> scored{0};
  const auto tasks =
      std::min<std::size_t>(headings.size(), static_cast<std::size_t>(4 * thread_count(query.threads)));
  parallel_for(tasks, query.threads, [&](std::size_t task) {
    HeadingScorer scorer(search);
    for (std::size_t i = task; i < headings.size(); i += tasks) {
      if (!scorer.score(headings[i], found[i])) cut_short = true;
      keep_rivals(found[i], search.margin);
      scored += query.domain.mask_of_heading[static_cast<std::size_t>(headings[i])]->count();
    }
  });
  for (const std::vector<Candidate>& some : found)
    proposal.candidates.insert(proposal.candidates.end(), some.begin(), some.end());
  keep_rivals(proposal.candidates, search.margin);
  proposal.proven = !cut_short;
  proposal.counts.poses_scored = scored;
  proposal.perfect_score = perfect;
  return proposal;
}

}  // namespace

Proposal propose_grid(const Query& query) {
  return propose(query, Contours::corrected, LocalGrids::oriented);
}
Proposal propose_grid_uncorrected(const Query& query) {
  return propose(query, Contours::uncorrected, LocalGrids::oriented);
}
Proposal propose_grid_turned(const Query& query) {
  return propose(query, Contours::corrected, LocalGrids::turned);
}

}  // namespace landfall::internal
