// Blocks of 8 x 8 poses at one heading: bounded a tile at a time, then scored. One per thread.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <thread>
#include <vector>

#include "engine/methods/best_score.hpp"
#include "engine/methods/dense_bounds.hpp"
#include "engine/query.hpp"

namespace landfall::internal {

// Cells of the end points at every heading, computed when first asked for; by several threads at a time.
// (std::call_once makes a system call each time; who comes meanwhile waits for less than a microsecond.)
class HeadingCellsOnDemand {
 public:
  HeadingCellsOnDemand(const EndPoints& points, const Lattice& lattice)
      : points_(points),
        lattice_(lattice),
        cells_(static_cast<std::size_t>(lattice.headings)),
        state_(std::make_unique<std::atomic<State>[]>(cells_.size())) {}

  const HeadingCells& at(int heading) {
    const auto k = static_cast<std::size_t>(heading);
    while (state_[k].load(std::memory_order_acquire) != State::ready) {
      State expected = State::none;
      if (!state_[k].compare_exchange_strong(expected, State::under_way, std::memory_order_acquire)) {
        std::this_thread::yield();
        continue;
      }
      try {
        cells_at_heading(points_, lattice_, heading, cells_[k]);
      } catch (...) {
        state_[k].store(State::none, std::memory_order_release);  // nobody shall wait for ever
        throw;
      }
      state_[k].store(State::ready, std::memory_order_release);
    }
    return cells_[k];
  }

 private:
  enum class State : std::uint8_t { none, under_way, ready };

  const EndPoints& points_;
  const Lattice& lattice_;
  std::vector<HeadingCells> cells_;
  std::unique_ptr<std::atomic<State>[]> state_;
};

// What the threads of one search share.
struct SharedSearch {
  const Query& query;
  kernels::WindowMaxima maxima;
  kernels::WindowPlanes planes;
  std::unique_ptr<HeadingCellsOnDemand> heading_cells;
  RivalMargin margin{};
  BestScore best{};

  // What a pose must score to be worth looking for.
  [[nodiscard]] std::int32_t lowest() const { return lowest_rival(best.get(), margin); }
};

// A block at one heading that has been bounded and not yet scored.
struct PendingBlock {
  std::int32_t bound;
  std::int32_t heading;
  std::int32_t row;
  std::int32_t col;
};

class BlockScorer {
 public:
  explicit BlockScorer(SharedSearch& search) : search_(search) {}

  // A node's blocks at every heading of [first, last) but one.
  void visit(const Node& node, int first_heading, int last_heading, int but = -1);
  // A node's blocks at one heading, bounded. Of those that may reach the score that matters the most
  // promising are scored, the others wait in `pending`.
  void bound(const Node& node, int heading);
  void score(const PendingBlock& block);
  // Of a node's blocks at one heading that of the best bound alone, for its score.
  void dive(const Node& node, int heading);

  std::vector<PendingBlock> pending;
  std::vector<Candidate> candidates;
  std::int64_t bounds_computed = 0;
  std::int64_t poses_scored = 0;

 private:
  // Blocks of the node at one heading that may reach the score that matters; bits row * tile_cols + col.
  std::uint64_t bound_blocks(const Node& node, std::uint64_t blocks, const HeadingCells& cells);
  [[nodiscard]] int best_of(std::uint64_t blocks) const;
  void visit_blocks(const Node& node, std::uint64_t blocks, int heading, const BlockMask& mask);
  void score(int row, int col, int heading, const BlockMask& mask, std::int32_t lowest);
  [[nodiscard]] const BlockMask* mask_at(int heading) const {
    return search_.query.domain.mask_of_heading[static_cast<std::size_t>(heading)].get();
  }

  SharedSearch& search_;
  std::int32_t best_bound_ = 0;  // of those that bound() has seen
  std::array<std::int32_t, kernels::tile_blocks> bounds_{};
};

}  // namespace landfall::internal
