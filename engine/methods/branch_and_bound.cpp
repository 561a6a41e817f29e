// The same optimum as `exhaustive`, proven, without scoring every pose (Olson 2009, 2015; Hess et al.
// 2016). What is ours: bounds are computed densely, many neighbouring blocks in a vector, for groups of
// headings, over all tiles that hold a free cell; their best blocks give the first incumbent; what
// survives it is bounded heading by heading and then scored 64 poses at a time, best bound first.
#include <algorithm>
#include <memory>

#include "engine/methods/block_scorer.hpp"
#include "engine/methods/dense_bounds.hpp"
#include "engine/methods/table.hpp"
#include "engine/parallel.hpp"

namespace landfall::internal {
namespace {

class BranchAndBound {
 public:
  explicit BranchAndBound(const Query& query)
      : query_(query),
        groups_(choose_groups(query.points, query.lattice)),
        search_{.query = query,
                .planes = query.map.window_tables().planes(),
                .heading_cells = std::vector<HeadingCells>(static_cast<std::size_t>(query.lattice.headings)),
                .margin = query.margin} {}

  Proposal run() {
    compute_heading_cells();
    if (query_.domain.poses <= few_poses) {
      take_all_blocks();
    } else {
      bound_and_collect();
    }
    score_survivors();
    return std::move(proposal_);
  }

 private:
  // So few are scored without dense bounds before them.
  static constexpr std::int64_t few_poses = 200'000;

  void compute_heading_cells() {
    parallel_for(static_cast<std::size_t>(groups_.count()), query_.threads, [&](std::size_t group) {
      for (int k = groups_.first(static_cast<int>(group)); k < groups_.last(static_cast<int>(group)); ++k)
        if (query_.domain.mask_of_heading[static_cast<std::size_t>(k)] != nullptr)
          cells_at_heading(query_.points, query_.lattice, k,
                           search_.heading_cells[static_cast<std::size_t>(k)]);
    });
  }

  void take_all_blocks() {
    for (int group = 0; group < groups_.count(); ++group) {
      const BlockMask box = group_mask(group);
      for (int row = box.first_row; row < box.first_row + box.rows; ++row)
        for (int col = box.first_col; col < box.first_col + box.cols; ++col)
          if (box.at(col, row) != 0)
            nodes_.push_back({.bound = no_bound,
                              .group = static_cast<std::uint16_t>(group),
                              .row = static_cast<std::uint16_t>(row),
                              .col = static_cast<std::uint16_t>(col)});
    }
  }

  [[nodiscard]] BlockMask group_mask(int group) const {
    BlockMask any;
    const BlockMask* last = nullptr;
    for (int k = groups_.first(group); k < groups_.last(group); ++k) {
      const SharedMask& mask = query_.domain.mask_of_heading[static_cast<std::size_t>(k)];
      if (mask == nullptr || mask.get() == last) continue;
      any = merged(any, *mask);
      last = mask.get();
    }
    return any;
  }

  void bound_and_collect() {
    constexpr std::size_t dives = 24;
    DenseBounds bounds(query_, groups_);
    for (int first = 0; first < groups_.count() && !query_.out_of_time();
         first += bounds.groups_at_a_time()) {
      const int last = std::min(groups_.count(), first + bounds.groups_at_a_time());
      proposal_.counts.bounds_computed += bounds.compute(first, last, search_.lowest());
      find_incumbent(bounds.best_of_tiles(dives));
      const std::vector<Node> survivors = bounds.survivors(search_.lowest());
      nodes_.insert(nodes_.end(), survivors.begin(), survivors.end());
    }
    std::sort(nodes_.begin(), nodes_.end(), PromisesMore());
  }

  // These nodes survive and are visited again; what they gave counts where time runs out before that.
  void find_incumbent(const std::vector<Node>& nodes) {
    BlockScorer scorer(search_);
    for (const Node& node : nodes) visit(scorer, node);
    proposal_.counts.bounds_computed += scorer.bounds_computed;
    early_candidates_.insert(early_candidates_.end(), scorer.candidates.begin(), scorer.candidates.end());
  }

  void visit(BlockScorer& scorer, const Node& node) const {
    scorer.visit(groups_.first(node.group), groups_.last(node.group), node.row, node.col);
  }

  void score_survivors() {
    constexpr std::size_t nodes_per_turn = 16;
    const auto turns = static_cast<int>(nodes_.size() / nodes_per_turn) + 1;
    std::vector<std::unique_ptr<BlockScorer>> scorers(
        static_cast<std::size_t>(std::min(thread_count(query_.threads), turns)));
    std::atomic<std::size_t> next{0};
    parallel_for(scorers.size(), query_.threads, [&](std::size_t i) {
      scorers[i] = std::make_unique<BlockScorer>(search_);
      while (!query_.out_of_time()) {
        const std::size_t first = next.fetch_add(nodes_per_turn);
        // Nodes come best first: once one is excluded, so is the rest.
        if (first >= nodes_.size() ||
            nodes_[first].bound < std::min<std::int64_t>(no_bound, table_units(search_.lowest())))
          return;
        const std::size_t last = std::min(nodes_.size(), first + nodes_per_turn);
        for (std::size_t n = first; n < last; ++n) visit(*scorers[i], nodes_[n]);
      }
    });
    for (const auto& scorer : scorers) {
      proposal_.candidates.insert(proposal_.candidates.end(), scorer->candidates.begin(),
                                  scorer->candidates.end());
      proposal_.counts.bounds_computed += scorer->bounds_computed;
      proposal_.counts.poses_scored += scorer->poses_scored;
    }
    proposal_.proven = !query_.out_of_time();
    if (!proposal_.proven) add_early_candidates();
    keep_rivals(proposal_.candidates, query_.margin);
  }

  void add_early_candidates() {
    std::vector<Candidate>& all = proposal_.candidates;
    all.insert(all.end(), early_candidates_.begin(), early_candidates_.end());
    std::sort(all.begin(), all.end(), better);
    const auto same = [](const Candidate& a, const Candidate& b) { return a.pose == b.pose; };
    all.erase(std::unique(all.begin(), all.end(), same), all.end());
  }

  const Query& query_;
  HeadingGroups groups_;
  SharedSearch search_;
  std::vector<Node> nodes_;
  std::vector<Candidate> early_candidates_;
  Proposal proposal_;
};

}  // namespace

Proposal propose_branch_and_bound(const Query& query) {
  return BranchAndBound(query).run();
}

}  // namespace landfall::internal
