// The same optimum as `exhaustive`, proven, without scoring every pose (Olson 2009, 2015; Hess et al.
// 2016). What is ours: bounds are computed densely, many neighbouring blocks in a vector, for groups of
// headings; a coarse level finds the first incumbent and excludes tiles of the finer one; what survives
// is bounded per heading and then scored 64 poses at a time.
//
// 1. bound_densely    blocks of 8 x 8 cells x a group of headings, wherever the prior has a free cell
// 2. find_incumbent   score the few best of these
// 3. collect          what may still hold a rival
// 4. score_survivors  best bound first, heading by heading
#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>

#include "engine/methods/group_points.hpp"
#include "engine/methods/table.hpp"
#include "engine/parallel.hpp"

namespace landfall::internal {
namespace {

using kernels::block_cells;
using kernels::tile_cols;
using kernels::tile_rows;
using kernels::tile_blocks;

struct Node {
  std::uint16_t bound;  // table units
  std::uint16_t group;
  std::uint16_t row;  // block
  std::uint16_t col;
};

struct Tile {
  int col;  // block
  int row;
  std::array<std::uint16_t, kernels::tile_blocks> lanes;  // all ones where some heading may stand
};

int divide_up(int a, int b) { return (a + b - 1) / b; }

class BranchAndBound {
 public:
  explicit BranchAndBound(const Query& query)
      : query_(query), planes_(query.map.window_tables().planes()) {}

  Proposal run() {
    choose_groups();
    compute_heading_cells();
    if (query_.domain.poses <= few_poses) {
      take_all_blocks();
    } else {
      place_tiles();
      const int per_chunk = static_cast<int>(std::max<std::size_t>(1, most_bounds / (tiles_.size() * tile_blocks)));
      for (int first = 0; first < groups_ && !cut_short_; first += per_chunk) {
        const int last = std::min(groups_, first + per_chunk);
        bound_densely(first, last);
        find_incumbent(first, last);
        collect(first, last);
      }
    }
    score_survivors();
    return finish();
  }

 private:
  static constexpr std::int64_t few_poses = 200'000;
  static constexpr std::size_t most_bounds = std::size_t{1} << 25;  // kept at a time: 64 MB

  [[nodiscard]] std::int32_t lowest() const { return lowest_rival(best_.load(std::memory_order_relaxed), query_.points.size()); }

  // Groups so wide that a typical end point moves by about half a block over one.
  void choose_groups() {
    double mean_cells = 0.0;
    for (std::size_t i = 0; i < query_.points.size(); ++i)
      mean_cells += std::hypot(query_.points.x_cells[i], query_.points.y_cells[i]) / static_cast<double>(query_.points.size());
    const double headings = 6.0 / std::max(1.0, mean_cells * query_.lattice.heading_step_rad());
    group_headings_ = std::clamp(static_cast<int>(std::bit_floor(static_cast<unsigned>(headings + 1.0))), 1, 16);
    if (const char* forced = std::getenv("LF_G")) group_headings_ = std::atoi(forced);
    groups_ = divide_up(query_.lattice.headings, group_headings_);
    block_cols_ = divide_up(query_.lattice.width_cells, block_cells);
    block_rows_ = divide_up(query_.lattice.height_cells, block_cells);
  }

  void compute_heading_cells() {
    heading_cells_.resize(static_cast<std::size_t>(query_.lattice.headings));
    parallel_for(static_cast<std::size_t>(groups_), query_.threads, [&](std::size_t group) {
      for (int k = first_heading(static_cast<int>(group)); k < last_heading(static_cast<int>(group)); ++k)
        if (query_.domain.mask_of_heading[static_cast<std::size_t>(k)] != nullptr)
          cells_at_heading(query_.points, query_.lattice, k, heading_cells_[static_cast<std::size_t>(k)]);
    });
  }

  [[nodiscard]] int first_heading(int group) const { return group * group_headings_; }
  [[nodiscard]] int last_heading(int group) const {
    return std::min(query_.lattice.headings, (group + 1) * group_headings_);
  }
  [[nodiscard]] std::uint64_t allowed(int group, int row, int col) const {
    std::uint64_t word = 0;
    const BlockMask* last = nullptr;
    for (int k = first_heading(group); k < last_heading(group); ++k) {
      const BlockMask* mask = query_.domain.mask_of_heading[static_cast<std::size_t>(k)].get();
      if (mask == nullptr || mask == last) continue;
      word |= mask->at(col, row);
      last = mask;
    }
    return word;
  }

  void take_all_blocks() {
    for (int group = 0; group < groups_; ++group) {
      BlockMask box;
      for (int k = first_heading(group); k < last_heading(group); ++k) {
        const SharedMask& mask = query_.domain.mask_of_heading[static_cast<std::size_t>(k)];
        if (mask == nullptr) continue;
        if (box.words.empty()) box = *mask;
        else if (k > 0 && mask != query_.domain.mask_of_heading[static_cast<std::size_t>(k - 1)]) box = merged(box, *mask);
      }
      for (int row = box.first_row; row < box.first_row + box.rows; ++row)
        for (int col = box.first_col; col < box.first_col + box.cols; ++col)
          if (box.at(col, row) != 0)
            nodes_.push_back({65535, static_cast<std::uint16_t>(group), static_cast<std::uint16_t>(row), static_cast<std::uint16_t>(col)});
    }
  }

  // Rows of tiles, each begun at the next block that some heading may stand in.
  void place_tiles() {
    BlockMask any;
    const BlockMask* last = nullptr;
    for (const SharedMask& mask : query_.domain.mask_of_heading) {
      if (mask == nullptr || mask.get() == last) continue;
      any = merged(any, *mask);
      last = mask.get();
    }
    for (int row = any.first_row; row < any.first_row + any.rows; row += tile_rows) {
      const auto used = [&](int col) {
        for (int r = row; r < row + tile_rows; ++r)
          if (any.at(col, r) != 0) return true;
        return false;
      };
      for (int col = any.first_col; col < any.first_col + any.cols; ++col) {
        if (!used(col)) continue;
        Tile tile{.col = col, .row = row, .lanes = {}};
        for (int r = 0; r < tile_rows; ++r)
          for (int c = 0; c < tile_cols; ++c)
            tile.lanes[static_cast<std::size_t>(r * tile_cols + c)] = any.at(col + c, row + r) != 0 ? 0xFFFF : 0;
        tiles_.push_back(tile);
        col += tile_cols - 1;
      }
    }
  }

  // 1.
  void bound_densely(int first, int last) {
    const std::size_t count = static_cast<std::size_t>(last - first);
    bounds_.resize(count * tiles_.size() * tile_blocks);
    largest_.assign(count * tiles_.size(), 0);
    unbounded_.resize(static_cast<std::size_t>(groups_));
    const BoundTable& table = query_.map.bound_table();
    const kernels::BoundPlanes planes = table.planes();
    parallel_for(count, query_.threads, [&](std::size_t g) {
      if (query_.out_of_time()) {
        cut_short_ = true;
        return;
      }
      const int group = first + static_cast<int>(g);
      GroupPoints points;
      points.build(query_.points, query_.lattice, table, first_heading(group), last_heading(group));
      unbounded_[static_cast<std::size_t>(group)] = points.unbounded();
      const int threshold = points.threshold(lowest());
      for (std::size_t t = 0; t < tiles_.size(); ++t) {
        std::uint16_t* sums = bounds_.data() + (g * tiles_.size() + t) * tile_blocks;
        if (!kernels::bound_tile(planes, points.view(), tiles_[t].col, tiles_[t].row, threshold, points.scratch().data(), sums)) continue;
        largest_[g * tiles_.size() + t] = mask_lanes(tiles_[t], sums);
      }
    });
    bounds_computed_ += static_cast<std::int64_t>(bounds_.size());
  }

  static std::uint16_t mask_lanes(const Tile& tile, std::uint16_t* sums) {
    std::uint16_t largest = 0;
    for (std::size_t i = 0; i < tile_blocks; ++i) {
      sums[i] = static_cast<std::uint16_t>(sums[i] & tile.lanes[i]);
      largest = std::max(largest, sums[i]);
    }
    return largest;
  }

  [[nodiscard]] Node node(int group, const Tile& tile, std::size_t lane, std::uint16_t bound) const {
    const int full = std::min(65535, bound + unbounded_[static_cast<std::size_t>(group)] * kernels::bound_levels);
    return {static_cast<std::uint16_t>(full), static_cast<std::uint16_t>(group),
            static_cast<std::uint16_t>(tile.row + static_cast<int>(lane) / tile_cols),
            static_cast<std::uint16_t>(tile.col + static_cast<int>(lane) % tile_cols)};
  }

  // 2.
  void find_incumbent(int first, int last) {
    constexpr std::size_t tops = 24;
    std::vector<Node> best;
    for (std::size_t i = 0; i < largest_.size(); ++i) {
      if (largest_[i] == 0) continue;
      const std::uint16_t* sums = bounds_.data() + i * tile_blocks;
      const auto lane = static_cast<std::size_t>(std::max_element(sums, sums + tile_blocks) - sums);
      best.push_back(node(first + static_cast<int>(i / tiles_.size()), tiles_[i % tiles_.size()], lane, sums[lane]));
    }
    (void)last;
    const std::size_t kept = std::min(tops, best.size());
    std::partial_sort(best.begin(), best.begin() + static_cast<std::ptrdiff_t>(kept), best.end(), [](const Node& a, const Node& b) { return a.bound > b.bound; });
    Worker worker(*this);
    for (std::size_t i = 0; i < kept; ++i) worker.visit(best[i]);
    bounds_computed_ += worker.bounds_computed;  // its candidates are met again below
    if (std::getenv("LF_DEBUG")) fprintf(stderr, "inc %d ", best_.load());
  }

  // 3.
  void collect(int first, int last) {
    std::vector<std::vector<Node>> found(static_cast<std::size_t>(last - first));
    parallel_for(found.size(), query_.threads, [&](std::size_t g) {
      const int group = first + static_cast<int>(g);
      const std::int64_t levels = (std::int64_t{lowest()} * kernels::bound_levels + 254) / 255;
      const int threshold = static_cast<int>(std::clamp<std::int64_t>(levels - std::int64_t{unbounded_[static_cast<std::size_t>(group)]} * kernels::bound_levels, 1, 65535));
      for (std::size_t t = 0; t < tiles_.size(); ++t) {
        if (largest_[g * tiles_.size() + t] < threshold) continue;
        const std::uint16_t* sums = bounds_.data() + (g * tiles_.size() + t) * tile_blocks;
        for (std::size_t lane = 0; lane < tile_blocks; ++lane)
          if (sums[lane] >= threshold) found[g].push_back(node(group, tiles_[t], lane, sums[lane]));
      }
    });
    for (const auto& some : found) nodes_.insert(nodes_.end(), some.begin(), some.end());
    std::sort(nodes_.begin(), nodes_.end(), [](const Node& a, const Node& b) { return a.bound > b.bound; });
  }

  // What one thread needs to score blocks.
  class Worker {
   public:
    explicit Worker(BranchAndBound& search) : search_(search), index_(search.query_.points.size()) {}

    void visit(const Node& node) {
      for (int heading = search_.first_heading(node.group); heading < search_.last_heading(node.group); ++heading) {
        if (allowed(heading, node.row, node.col) == 0) continue;
        const std::int32_t lowest = search_.lowest();
        if (bound(heading, node.row, node.col, lowest) >= lowest) score(heading, node.row, node.col, lowest);
      }
    }

    std::vector<Candidate> candidates;
    std::int64_t bounds_computed = 0;
    std::int64_t blocks_scored = 0;

   private:
    [[nodiscard]] std::uint64_t allowed(int heading, int row, int col) const {
      const SharedMask& mask = search_.query_.domain.mask_of_heading[static_cast<std::size_t>(heading)];
      return mask == nullptr ? 0 : mask->at(col, row);
    }

    std::int32_t bound(int heading, int row, int col, std::int32_t threshold) {
      const HeadingCells& cells = search_.heading_cells_[static_cast<std::size_t>(heading)];
      kernels::window_indices(search_.planes_, col * block_cells, row * block_cells, cells.col.data(), cells.row.data(),
                              index_.size(), index_.data());
      ++bounds_computed;
      return kernels::bound_block(search_.planes_, index_.data(), index_.size(), threshold);
    }

    // After bound() of the same block and heading.
    void score(int heading, int row, int col, std::int32_t lowest) {
      std::int32_t scores[kernels::block_poses];
      ++blocks_scored;
      if (!kernels::score_block(search_.planes_, index_.data(), index_.size(), lowest, scores)) return;
      const Candidate candidate = best_of_block(scores, allowed(heading, row, col), heading, row, col);
      if (candidate.score < lowest) return;
      candidates.push_back(candidate);
      std::int32_t best = search_.best_.load(std::memory_order_relaxed);
      while (candidate.score > best && !search_.best_.compare_exchange_weak(best, candidate.score)) {
      }
    }

    BranchAndBound& search_;
    std::vector<std::int32_t> index_;
  };

  // 4.
  void score_survivors() {
    constexpr std::size_t nodes_per_turn = 16;
    const int threads = std::min(thread_count(query_.threads), static_cast<int>(nodes_.size() / nodes_per_turn) + 1);
    std::atomic<std::size_t> next{0};
    std::vector<std::unique_ptr<Worker>> workers(static_cast<std::size_t>(threads));
    parallel_for(workers.size(), query_.threads, [&](std::size_t i) {
      workers[i] = std::make_unique<Worker>(*this);
      while (true) {
        const std::size_t first = next.fetch_add(nodes_per_turn);
        if (first >= nodes_.size()) return;
        if (query_.out_of_time()) { cut_short_ = true; return; }
        const std::size_t last = std::min(nodes_.size(), first + nodes_per_turn);
        // The rest of the nodes have lower bounds still.
        if (std::int64_t{nodes_[first].bound} * 255 < std::int64_t{lowest()} * kernels::bound_levels && nodes_[first].bound < 65535) return;
        for (std::size_t n = first; n < last; ++n) workers[i]->visit(nodes_[n]);
      }
    });
    for (const auto& worker : workers) merge(*worker);
  }

  void merge(Worker& worker) {
    candidates_.insert(candidates_.end(), worker.candidates.begin(), worker.candidates.end());
    bounds_computed_ += worker.bounds_computed;
    blocks_scored_ += worker.blocks_scored;
  }

  Proposal finish() {
    keep_rivals(candidates_, query_.points.size());
    long live=0; for (auto& n: nodes_) live += std::int64_t{n.bound}*255 >= std::int64_t{lowest()}*31; if (std::getenv("LF_DEBUG")) fprintf(stderr,"live %ld ",live), fprintf(stderr, "G %d pts %zu best %d (%.2f) nodes %zu bounds %ld scored %ld cand %zu\n", group_headings_, query_.points.size(), best_.load(), best_.load()/255.0/query_.points.size(), nodes_.size(), long(bounds_computed_), long(blocks_scored_), candidates_.size());
    Proposal proposal{.candidates = std::move(candidates_), .proven = !cut_short_, .counts = {}};
    proposal.counts.bounds_computed = bounds_computed_;
    proposal.counts.poses_scored = blocks_scored_ * kernels::block_poses;
    return proposal;
  }

  const Query& query_;
  kernels::WindowPlanes planes_;
  int group_headings_ = 1;
  int groups_ = 0;
  int block_cols_ = 0;
  int block_rows_ = 0;
  std::vector<HeadingCells> heading_cells_;
  std::vector<Tile> tiles_;
  std::vector<std::uint16_t> bounds_;        // [group of the chunk][tile][block], table units
  std::vector<std::uint16_t> largest_;       // [group of the chunk][tile]
  std::vector<std::int32_t> unbounded_;      // [group]
  std::vector<Node> nodes_;
  std::vector<Candidate> candidates_;
  std::atomic<std::int32_t> best_{0};
  std::atomic<bool> cut_short_{false};
  std::int64_t bounds_computed_ = 0;
  std::int64_t blocks_scored_ = 0;
};

}  // namespace

Proposal propose_branch_and_bound(const Query& query) { return BranchAndBound(query).run(); }

}  // namespace landfall::internal
