// The same optimum as `exhaustive`, proven, without scoring every pose (Olson 2009, 2015; Hess et al.
// 2016). What is ours: bounds are computed densely, many neighbouring blocks in a vector, for groups of
// headings, over all tiles that hold a free cell; their best blocks give the first incumbent; what
// survives it is bounded heading by heading, again a tile at a time, and then scored 64 poses at a time.
#include <algorithm>
#include <atomic>
#include <memory>
#include <numbers>
#include <optional>

#include "engine/base/parallel.hpp"
#include "engine/methods/branch_and_bound/block_scorer.hpp"
#include "engine/methods/branch_and_bound/dense_bounds.hpp"
#include "engine/methods/branch_and_bound/point_order.hpp"
#include "engine/methods/table.hpp"

namespace landfall::internal {
namespace {

class BranchAndBound {
 public:
  explicit BranchAndBound(const Query& query)
      : query_(query),
        groups_(choose_groups(query.points, query.lattice)),
        search_{.query = query,
                .maxima = query.map.window_tables().maxima(),
                .planes = query.map.window_tables().planes(),
                .points = std::make_unique<PointsOnDemand>(query.points, query.lattice,
                                                           query.map.window_tables().maxima()),
                .margin = query.margin} {}

  Proposal run() {
    if (query_.domain.poses <= few_poses) {
      take_all_blocks();
      dive_into_each();
    } else {
      bound_and_collect();
    }
    score_survivors();
    return std::move(proposal_);
  }

 private:
  // So few are scored without dense bounds before them.
  static constexpr std::int64_t few_poses = 200'000;
  // So few are visited without a thought to the order of the points.
  static constexpr std::size_t few_nodes = 1000;

  // The headings in the middle come first: the robot is mostly where a prior says, and a good pose early
  // excludes the others.
  void take_all_blocks() {
    const TileLayout layout(blocks_of(query_.domain.mask_of_heading));
    std::vector<int> groups;
    for (int group = 0; group < groups_.count(); ++group)
      if (has_poses(group)) groups.push_back(group);
    const auto middle = static_cast<std::ptrdiff_t>(groups.size() / 2);
    std::rotate(groups.begin(), groups.begin() + middle, groups.end());
    for (const int group : groups)
      for (std::size_t tile = 0; tile < layout.size(); ++tile)
        nodes_.push_back({.lanes = layout.allowed[tile],
                          .bound = no_bound,
                          .group = static_cast<std::uint16_t>(group),
                          .row = static_cast<std::uint16_t>(layout.tiles[tile].row),
                          .col = static_cast<std::uint16_t>(layout.tiles[tile].col)});
  }

  // A pose near the best one, before others are scored.
  void dive_into_each() {
    BlockScorer scorer(search_);
    for (const Node& node : nodes_) {
      if (query_.out_of_time()) return;
      scorer.dive(node, middle(node.group));
    }
    take_early(scorer);
  }

  [[nodiscard]] bool has_poses(int group) const {
    const auto begin = query_.domain.mask_of_heading.begin();
    return std::any_of(begin + groups_.first(group), begin + groups_.last(group),
                       [](const SharedMask& mask) { return mask != nullptr; });
  }

  // Where the prior is anywhere in the free space.
  [[nodiscard]] const SearchTiles* tiles_of_the_map() const {
    const std::vector<SharedMask>& masks = query_.domain.mask_of_heading;
    const bool all_alike = std::all_of(masks.begin(), masks.end(),
                                       [&](const SharedMask& mask) { return mask == masks.front(); });
    return all_alike ? query_.map.tiles_of(masks.front()) : nullptr;
  }

  // Of the blocks beside a pose the best one at every heading that odometry may have meant.
  void look_around(const Pose2& T_map_robot) {
    constexpr double most_off_rad = std::numbers::pi / 12.0;
    const Lattice& lattice = query_.lattice;
    const LatticePose center = lattice.nearest(T_map_robot);
    if (!lattice.contains(center)) return;
    Node beside{.row = static_cast<std::uint16_t>(std::max(0, center.row / kernels::block_cells - 1)),
                .col = static_cast<std::uint16_t>(std::max(0, center.col / kernels::block_cells - 1))};
    for (int row = 0; row < 3; ++row)
      for (int col = 0; col < 3; ++col) beside.lanes |= std::uint64_t{1} << kernels::tile_lane(col, row);
    const int most_off =
        std::min((lattice.headings - 1) / 2, static_cast<int>(most_off_rad / lattice.heading_step_rad()));
    BlockScorer scorer(search_);
    for (int off = 0; off <= most_off; ++off) {
      scorer.dive(beside, (center.heading + off) % lattice.headings);
      if (off > 0) scorer.dive(beside, (center.heading + lattice.headings - off) % lattice.headings);
    }
    take_early(scorer);
  }

  // Whether a guess was worth about what it promised.
  bool try_guess() {
    constexpr double least_share = 0.8;
    if (!query_.guess) return false;
    look_around(query_.guess->T_map_robot);
    const double promised = query_.guess->score_per_echo * static_cast<double>(query_.points.size());
    return search_.best.get() >= least_share * promised;
  }

  void bound_and_collect() {
    constexpr double promising_share = 0.015;  // of the coarse tiles: the best pose is mostly in one of them
    constexpr std::size_t dives = 24;
    std::optional<SearchTiles> own_tiles;
    const SearchTiles* tiles = tiles_of_the_map();
    if (tiles == nullptr) tiles = &own_tiles.emplace(blocks_of(query_.domain.mask_of_heading));
    const BoundLevel small{
        .query = query_, .table = query_.map.bound_table(), .groups = groups_, .layout = tiles->small};
    const BoundLevel large{.query = query_,
                           .table = query_.map.coarse_bound_table(),
                           .groups = groups_.doubled(),
                           .layout = tiles->large};
    CoarseBounds coarse(large);
    FineBounds fine(small, coarse, tiles->parts);
    const bool has_incumbent = try_guess();
    for (int first = 0; first < large.groups.count() && !query_.out_of_time();
         first += coarse.groups_at_a_time()) {
      const int last = std::min(large.groups.count(), first + coarse.groups_at_a_time());
      proposal_.counts.bounds_computed += coarse.compute(first, last, table_units(search_.lowest()));
      if (!has_incumbent)
        find_incumbent(fine.best_of_tiles(first, last, coarse.best(promising_share), dives));
      const std::vector<Node> survivors = fine.survivors(first, last, search_.lowest());
      nodes_.insert(nodes_.end(), survivors.begin(), survivors.end());
    }
    proposal_.counts.bounds_computed += fine.bounds_computed;
    sort_nodes(nodes_);
    if (nodes_.size() > few_nodes) {
      telling_points_ = most_telling_first(query_.points, search_, groups_, nodes_);
      search_.points = std::make_unique<PointsOnDemand>(telling_points_, query_.lattice, search_.maxima);
    }
  }

  // These nodes are visited again later; what they gave counts where time runs out before that.
  void find_incumbent(const std::vector<Node>& nodes) {
    std::vector<std::unique_ptr<BlockScorer>> scorers(
        static_cast<std::size_t>(std::max(1, thread_count(query_.threads))));
    std::atomic<std::size_t> next{0};
    parallel_for(scorers.size(), query_.threads, [&](std::size_t i) {
      scorers[i] = std::make_unique<BlockScorer>(search_);
      for (std::size_t n = next++; n < nodes.size(); n = next++) visit(*scorers[i], nodes[n]);
    });
    for (const auto& scorer : scorers) take_early(*scorer);
  }

  void take_early(const BlockScorer& scorer) {
    proposal_.counts.bounds_computed += scorer.bounds_computed;
    early_candidates_.insert(early_candidates_.end(), scorer.candidates.begin(), scorer.candidates.end());
  }

  // At every heading of its group but one.
  void visit(BlockScorer& scorer, const Node& node, int but = -1) const {
    scorer.visit(node, groups_.first(node.group), groups_.last(node.group), but);
  }

  // Nodes come best first: once one is excluded, so is the rest.
  [[nodiscard]] bool is_excluded(const Node& node) const {
    return node.bound < std::min<std::int64_t>(no_bound, table_units(search_.lowest()));
  }

  [[nodiscard]] int middle(int group) const { return (groups_.first(group) + groups_.last(group)) / 2; }

  // Calls visit(scorer, node) until nodes are excluded.
  template <class Visit>
  void for_each_node(std::vector<std::unique_ptr<BlockScorer>>& scorers, const Visit& visit) {
    constexpr std::size_t nodes_per_turn = 2;
    std::atomic<std::size_t> next{0};
    parallel_for(scorers.size(), query_.threads, [&](std::size_t i) {
      if (scorers[i] == nullptr) scorers[i] = std::make_unique<BlockScorer>(search_);
      while (!query_.out_of_time()) {
        const std::size_t first = next.fetch_add(nodes_per_turn);
        if (first >= nodes_.size() || is_excluded(nodes_[first])) return;
        const std::size_t last = std::min(nodes_.size(), first + nodes_per_turn);
        for (std::size_t n = first; n < last; ++n) visit(*scorers[i], nodes_[n]);
      }
    });
  }

  // Where many nodes survive, bounds for groups of headings tell little. Bounds at the middle heading of each
  // tell more: the blocks that are best by them mostly hold the best pose, whose score spares other headings.
  void score_middle_headings(std::vector<std::unique_ptr<BlockScorer>>& scorers) {
    constexpr std::size_t blocks_per_turn = 16;
    constexpr std::size_t best_first = 256;
    for_each_node(scorers,
                  [&](BlockScorer& scorer, const Node& node) { scorer.bound(node, middle(node.group)); });
    std::vector<PendingBlock> pending;
    for (const auto& scorer : scorers)
      pending.insert(pending.end(), scorer->pending.begin(), scorer->pending.end());
    const auto middle = pending.begin() + static_cast<std::ptrdiff_t>(std::min(best_first, pending.size()));
    // The rest stay as they were found, neighbours beside each other.
    std::partial_sort(pending.begin(), middle, pending.end(),
                      [](const PendingBlock& a, const PendingBlock& b) { return a.bound > b.bound; });
    std::atomic<std::size_t> next{0};
    parallel_for(scorers.size(), query_.threads, [&](std::size_t i) {
      while (!query_.out_of_time()) {
        const std::size_t first = next.fetch_add(blocks_per_turn);
        if (first >= pending.size()) return;
        const std::size_t last = std::min(pending.size(), first + blocks_per_turn);
        for (std::size_t n = first; n < last; ++n) scorers[i]->score(pending[n]);
      }
    });
  }

  void score_survivors() {
    const auto most_scorers = static_cast<int>(nodes_.size() / 2) + 1;
    std::vector<std::unique_ptr<BlockScorer>> scorers(
        static_cast<std::size_t>(std::min(thread_count(query_.threads), most_scorers)));
    const bool middle_first = nodes_.size() > few_nodes;
    if (middle_first) score_middle_headings(scorers);
    for_each_node(scorers, [&](BlockScorer& scorer, const Node& node) {
      visit(scorer, node, middle_first ? middle(node.group) : -1);
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
  EndPoints telling_points_;  // query_.points in another order
  std::vector<Candidate> early_candidates_;
  Proposal proposal_;
};

}  // namespace

Proposal propose_branch_and_bound(const Query& query) {
  return BranchAndBound(query).run();
}

}  // namespace landfall::internal
