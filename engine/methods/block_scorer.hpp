// Blocks of 8 x 8 poses at one heading: bounded, then scored. One per thread.
#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

#include "engine/methods/best_score.hpp"
#include "engine/query.hpp"

namespace landfall::internal {

// Cells of the end points at every heading, computed when first asked for; by several threads at a time.
class HeadingCellsOnDemand {
 public:
  HeadingCellsOnDemand(const EndPoints& points, const Lattice& lattice)
      : points_(points),
        lattice_(lattice),
        cells_(static_cast<std::size_t>(lattice.headings)),
        once_(std::make_unique<std::once_flag[]>(cells_.size())) {}

  const HeadingCells& at(int heading) {
    const auto k = static_cast<std::size_t>(heading);
    std::call_once(once_[k], [&] { cells_at_heading(points_, lattice_, heading, cells_[k]); });
    return cells_[k];
  }

 private:
  const EndPoints& points_;
  const Lattice& lattice_;
  std::vector<HeadingCells> cells_;
  std::unique_ptr<std::once_flag[]> once_;
};

// What the threads of one search share.
struct SharedSearch {
  const Query& query;
  kernels::WindowPlanes planes;
  std::unique_ptr<HeadingCellsOnDemand> heading_cells;
  RivalMargin margin{};
  BestScore best{};

  // What a pose must score to be worth looking for.
  [[nodiscard]] std::int32_t lowest() const { return lowest_rival(best.get(), margin); }
};

class BlockScorer {
 public:
  explicit BlockScorer(SharedSearch& search) : search_(search), index_(search.query.points.size()) {}

  // The block at every heading of [first, last).
  void visit(int first_heading, int last_heading, int block_row, int block_col);

  std::vector<Candidate> candidates;
  std::int64_t bounds_computed = 0;
  std::int64_t poses_scored = 0;

 private:
  void visit(int heading, std::uint64_t allowed, int block_row, int block_col);
  std::int32_t bound(const HeadingCells& cells, int block_row, int block_col, std::int32_t lowest);

  SharedSearch& search_;
  std::vector<std::int32_t> index_;
};

}  // namespace landfall::internal
