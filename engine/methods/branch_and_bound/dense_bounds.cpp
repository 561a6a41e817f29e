#include "engine/methods/branch_and_bound/dense_bounds.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <functional>
#include <numeric>

#include "engine/base/parallel.hpp"

namespace landfall::internal {
namespace {

using kernels::tile_blocks;

constexpr std::size_t most_bounds = std::size_t{1} << 25;  // 64 MB

// One a thread, for a search asks for it hundreds of times.
std::int32_t* scratch_of_thread(const Query& query) {
  static thread_local std::vector<std::int32_t> scratch;
  scratch.resize(query.points.size() + kernels::point_padding);
  return scratch.data();
}

Node make_node(int group, const TileLayout::Tile& tile, std::uint64_t lanes, std::int32_t bound) {
  return {.lanes = lanes,
          .bound = static_cast<std::uint16_t>(std::min<std::int32_t>(bound, no_bound)),
          .group = static_cast<std::uint16_t>(group),
          .row = static_cast<std::uint16_t>(tile.row),
          .col = static_cast<std::uint16_t>(tile.col)};
}

}  // namespace

int BoundLevel::least_sum(std::int64_t bound, std::int32_t unbounded) {
  return static_cast<int>(
      std::clamp<std::int64_t>(bound - std::int64_t{unbounded} * kernels::bound_levels, 0, 65535));
}

int CoarseBounds::groups_at_a_time() const {
  return static_cast<int>(
      std::max<std::size_t>(1, most_bounds / (std::max<std::size_t>(1, level_.layout.size()) * tile_blocks)));
}

std::int64_t CoarseBounds::compute(int first, int last, std::int64_t bound) {
  first_ = first;
  least_bound_ = bound;
  const auto count = static_cast<std::size_t>(last - first);
  const TileLayout& layout = level_.layout;
  bounds_.resize(count * layout.size() * tile_blocks);
  largest_.resize(count * layout.size());
  unbounded_.resize(count);
  parallel_for(count, level_.query.threads, [&](std::size_t g) {
    const int group = first + static_cast<int>(g);
    unbounded_[g] = 0;
    if (level_.query.out_of_time()) {
      std::fill_n(largest_.begin() + static_cast<std::ptrdiff_t>(g * layout.size()), layout.size(),
                  std::uint16_t{0});
      return;
    }
    static thread_local GroupPoints points;
    points.build(level_.query.points, level_.query.lattice, level_.table, level_.groups.first(group),
                 level_.groups.last(group));
    unbounded_[g] = points.unbounded();
    const int least = BoundLevel::least_sum(bound, points.unbounded());
    std::int32_t* scratch = scratch_of_thread(level_.query);
    for (const TileLayout::Run& run : layout.runs) {
      const std::size_t at = g * layout.size() + run.first;
      const TileLayout::Tile& tile = layout.tiles[run.first];
      kernels::bound_tiles(level_.table.planes(), points.view(), tile.col, tile.row, run.tiles, least,
                           layout.allowed.data() + run.first, scratch, bounds_.data() + at * tile_blocks,
                           largest_.data() + at);
    }
  });
  return static_cast<std::int64_t>(count * layout.size() * tile_blocks);
}

CoarseChoice CoarseBounds::best(double share_of_tiles) const {
  if (largest_.empty()) return {};
  std::vector<std::int64_t> bounds;
  bounds.reserve(largest_.size());
  for (std::size_t i = 0; i < largest_.size(); ++i)
    bounds.push_back(largest_[i] +
                     std::int64_t{unbounded_[i / level_.layout.size()]} * kernels::bound_levels);
  const auto wanted = static_cast<std::size_t>(share_of_tiles * static_cast<double>(bounds.size() - 1));
  std::nth_element(bounds.begin(), bounds.begin() + static_cast<std::ptrdiff_t>(wanted), bounds.end(),
                   std::greater<>());
  const std::int64_t bound = std::max(bounds[wanted], least_bound_);
  const auto last_better =
      std::partition(bounds.begin(), bounds.end(), [&](std::int64_t b) { return b > bound; });
  const auto equal = static_cast<std::size_t>(std::count(last_better, bounds.end(), bound));
  return {.bound = bound, .one_in = std::max<std::size_t>(1, equal / (8 * (wanted + 1)))};
}

bool CoarseBounds::mark(int group, const CoarseChoice& choice, std::span<const SearchTiles::Parts> parts,
                        std::vector<std::uint64_t>& needed) const {
  const auto g = static_cast<std::size_t>(group - first_);
  const int least = BoundLevel::least_sum(choice.bound, unbounded_[g]);
  bool any = false;
  for (std::size_t t = 0; t < level_.layout.size(); ++t) {
    const std::size_t at = g * level_.layout.size() + t;
    if (largest_[at] < least || (largest_[at] == least && at % choice.one_in != 0)) continue;
    any = true;
    std::uint64_t lanes = kernels::lanes_at_least(bounds_.data() + at * tile_blocks, least);
    for (; lanes != 0; lanes &= lanes - 1) {
      const SearchTiles::Parts& part =
          parts[t * tile_blocks + static_cast<std::size_t>(std::countr_zero(lanes))];
      needed[static_cast<std::size_t>(part.tile)] |= part.lanes;
    }
  }
  return any;
}

struct FineBounds::Tile {
  int group;
  int least;  // of its sums
  std::size_t index;
  std::uint64_t allowed;
  std::int32_t unbounded;
  std::uint16_t largest;
  const std::uint16_t* sums;
};

template <class Take>
std::int64_t FineBounds::visit_group(int group, std::int64_t bound, std::span<const std::uint64_t> needed,
                                     const Take& take) {
  const TileLayout& layout = level_.layout;
  GroupPoints& points = points_[static_cast<std::size_t>(group)];
  if (!points.is_built())
    points.build(level_.query.points, level_.query.lattice, level_.table, level_.groups.first(group),
                 level_.groups.last(group));
  const int least = BoundLevel::least_sum(bound, points.unbounded());
  std::int32_t* scratch = scratch_of_thread(level_.query);
  std::array<std::uint16_t, kernels::most_tiles * tile_blocks> sums;
  std::array<std::uint16_t, kernels::most_tiles> largest;
  std::int64_t tiles_computed = 0;
  for (const TileLayout::Run& run : layout.runs) {
    std::size_t begin = run.first;
    std::size_t end = begin + static_cast<std::size_t>(run.tiles);
    while (begin < end && needed[begin] == 0) ++begin;
    while (begin < end && needed[end - 1] == 0) --end;
    if (begin == end) continue;
    const TileLayout::Tile& tile = layout.tiles[begin];
    kernels::bound_tiles(level_.table.planes(), points.view(), tile.col, tile.row,
                         static_cast<int>(end - begin), least, needed.data() + begin, scratch, sums.data(),
                         largest.data());
    tiles_computed += static_cast<std::int64_t>(end - begin);
    for (std::size_t t = begin; t < end; ++t)
      if (needed[t] != 0 && largest[t - begin] >= least)
        take(Tile{.group = group,
                  .least = least,
                  .index = t,
                  .allowed = needed[t],
                  .unbounded = points.unbounded(),
                  .largest = largest[t - begin],
                  .sums = sums.data() + (t - begin) * tile_blocks});
  }
  return tiles_computed;
}

// take(i, tile) for every tile with a bound of at least `bound` that a chosen coarse block leads to; i: the
// coarse group, counted from `first`.
template <class Take>
void FineBounds::visit_tiles(int first, int last, const CoarseChoice& choice, std::int64_t bound,
                             const Take& take) {
  const TileLayout& layout = level_.layout;
  std::atomic<std::int64_t> tiles_computed{0};
  parallel_for(static_cast<std::size_t>(last - first), level_.query.threads, [&](std::size_t g) {
    const int coarse_group = first + static_cast<int>(g);
    static thread_local std::vector<std::uint64_t> needed;
    needed.assign(layout.size(), 0);
    if (level_.query.out_of_time() || !coarse_.mark(coarse_group, choice, parts_, needed)) return;
    for (std::size_t t = 0; t < needed.size(); ++t) needed[t] &= layout.allowed[t];
    for (int group = 2 * coarse_group; group < std::min(2 * coarse_group + 2, level_.groups.count()); ++group)
      tiles_computed += visit_group(group, bound, needed, [&](const Tile& tile) { take(g, tile); });
  });
  bounds_computed += tiles_computed * tile_blocks;
}

namespace {

std::vector<Node> joined(const std::vector<std::vector<Node>>& found) {
  std::size_t count = 0;
  for (const auto& some : found) count += some.size();
  std::vector<Node> all;
  all.reserve(count);
  for (const auto& some : found) all.insert(all.end(), some.begin(), some.end());
  return all;
}

}  // namespace

std::vector<Node> FineBounds::best_of_tiles(int first, int last, const CoarseChoice& choice,
                                            std::size_t most) {
  std::vector<std::vector<Node>> found(static_cast<std::size_t>(last - first));
  visit_tiles(first, last, choice, 0, [&](std::size_t i, const Tile& tile) {
    const std::uint64_t best = kernels::lanes_at_least(tile.sums, tile.largest) & tile.allowed;
    found[i].push_back(make_node(tile.group, level_.layout.tiles[tile.index], best & (0 - best),
                                 tile.largest + tile.unbounded * kernels::bound_levels));
  });
  std::vector<Node> all = joined(found);
  sort_nodes(all);
  if (all.size() > most) all.resize(most);
  return all;
}

std::vector<Node> FineBounds::survivors(int first, int last, std::int32_t lowest) {
  std::vector<std::vector<Node>> found(static_cast<std::size_t>(last - first));
  const std::int64_t bound = table_units(lowest);
  visit_tiles(first, last, {.bound = bound}, bound, [&](std::size_t i, const Tile& tile) {
    const std::uint64_t lanes = kernels::lanes_at_least(tile.sums, tile.least) & tile.allowed;
    found[i].push_back(make_node(tile.group, level_.layout.tiles[tile.index], lanes,
                                 tile.largest + tile.unbounded * kernels::bound_levels));
  });
  return joined(found);
}

void sort_nodes(std::vector<Node>& nodes) {
  if (nodes.empty()) return;
  const auto [least, most] = std::minmax_element(
      nodes.begin(), nodes.end(), [](const Node& a, const Node& b) { return a.bound < b.bound; });
  const std::size_t top = most->bound;
  std::vector<std::uint32_t> begin(top - least->bound + 2);
  for (const Node& node : nodes) ++begin[top - node.bound + 1];
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  std::vector<Node> sorted(nodes.size());
  for (const Node& node : nodes) sorted[begin[top - node.bound]++] = node;
  nodes = std::move(sorted);
}

}  // namespace landfall::internal
