#include "engine/methods/dense_bounds.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <functional>
#include <numeric>

#include "engine/parallel.hpp"

namespace landfall::internal {
namespace {

using kernels::tile_blocks;

constexpr std::size_t most_bounds = std::size_t{1} << 25;  // 64 MB

std::vector<std::int32_t> make_scratch(const Query& query) {
  return std::vector<std::int32_t>(query.points.size() + kernels::point_padding);
}

Node make_node(int group, const TileLayout::Tile& tile, std::size_t lane, std::int32_t bound) {
  return {.bound = static_cast<std::uint16_t>(std::min<std::int32_t>(bound, no_bound)),
          .group = static_cast<std::uint16_t>(group),
          .row = static_cast<std::uint16_t>(tile.row + kernels::lane_row(static_cast<int>(lane))),
          .col = static_cast<std::uint16_t>(tile.col + kernels::lane_col(static_cast<int>(lane)))};
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

std::int64_t CoarseBounds::compute(int first, int last) {
  first_ = first;
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
    GroupPoints points;
    points.build(level_.query.points, level_.query.lattice, level_.table, level_.groups.first(group),
                 level_.groups.last(group));
    unbounded_[g] = points.unbounded();
    std::vector<std::int32_t> scratch = make_scratch(level_.query);
    for (const TileLayout::Run& run : layout.runs) {
      const std::size_t at = g * layout.size() + run.first;
      const TileLayout::Tile& tile = layout.tiles[run.first];
      kernels::bound_tiles(level_.table.planes(), points.view(), tile.col, tile.row, run.tiles, 0,
                           layout.allowed.data() + std::size_t{run.first} * tile_blocks, scratch.data(),
                           bounds_.data() + at * tile_blocks, largest_.data() + at);
    }
  });
  return static_cast<std::int64_t>(count * layout.size() * tile_blocks);
}

std::int64_t CoarseBounds::bound_of_best(double share_of_tiles) const {
  if (largest_.empty()) return 0;
  std::vector<std::int64_t> bounds;
  bounds.reserve(largest_.size());
  for (std::size_t i = 0; i < largest_.size(); ++i)
    bounds.push_back(largest_[i] +
                     std::int64_t{unbounded_[i / level_.layout.size()]} * kernels::bound_levels);
  const auto wanted =
      bounds.begin() + static_cast<std::ptrdiff_t>(share_of_tiles * static_cast<double>(bounds.size() - 1));
  std::nth_element(bounds.begin(), wanted, bounds.end(), std::greater<>());
  return *wanted;
}

bool CoarseBounds::mark(int group, std::int64_t bound, std::span<const std::int32_t> tile_of_lane,
                        std::vector<std::uint8_t>& needed) const {
  const auto g = static_cast<std::size_t>(group - first_);
  const int least = BoundLevel::least_sum(bound, unbounded_[g]);
  bool any = false;
  for (std::size_t t = 0; t < level_.layout.size(); ++t) {
    const std::size_t at = g * level_.layout.size() + t;
    if (largest_[at] < least) continue;
    any = true;
    const std::uint16_t* sums = bounds_.data() + at * tile_blocks;
    for (std::size_t lane = 0; lane < tile_blocks; ++lane) {
      const std::int32_t tile = tile_of_lane[t * tile_blocks + lane];
      if (sums[lane] >= least && tile >= 0) needed[static_cast<std::size_t>(tile)] = 1;
    }
  }
  return any;
}

struct FineBounds::Tile {
  int group;
  int least;  // of its sums
  std::size_t index;
  std::int32_t unbounded;
  std::uint16_t largest;
  const std::uint16_t* sums;
};

template <class Take>
std::int64_t FineBounds::visit_group(int group, std::int64_t bound, const std::vector<std::uint8_t>& needed,
                                     std::vector<std::int32_t>& scratch, const Take& take) {
  const TileLayout& layout = level_.layout;
  GroupPoints& points = points_[static_cast<std::size_t>(group)];
  if (!points.is_built())
    points.build(level_.query.points, level_.query.lattice, level_.table, level_.groups.first(group),
                 level_.groups.last(group));
  const int least = BoundLevel::least_sum(bound, points.unbounded());
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
                         static_cast<int>(end - begin), least, layout.allowed.data() + begin * tile_blocks,
                         scratch.data(), sums.data(), largest.data());
    tiles_computed += static_cast<std::int64_t>(end - begin);
    for (std::size_t t = begin; t < end; ++t)
      if (needed[t] != 0 && largest[t - begin] >= least)
        take(Tile{.group = group,
                  .least = least,
                  .index = t,
                  .unbounded = points.unbounded(),
                  .largest = largest[t - begin],
                  .sums = sums.data() + (t - begin) * tile_blocks});
  }
  return tiles_computed;
}

// take(i, tile) for every tile with a bound of at least `bound` that a coarse block of at least
// `coarse_bound` leads to; i: the coarse group, counted from `first`.
template <class Take>
void FineBounds::visit_tiles(int first, int last, std::int64_t coarse_bound, std::int64_t bound,
                             const Take& take) {
  const TileLayout& layout = level_.layout;
  std::atomic<std::int64_t> tiles_computed{0};
  parallel_for(static_cast<std::size_t>(last - first), level_.query.threads, [&](std::size_t g) {
    const int coarse_group = first + static_cast<int>(g);
    std::vector<std::uint8_t> needed(layout.size());
    if (level_.query.out_of_time() || !coarse_.mark(coarse_group, coarse_bound, tile_of_lane_, needed))
      return;
    std::vector<std::int32_t> scratch = make_scratch(level_.query);
    for (int group = 2 * coarse_group; group < std::min(2 * coarse_group + 2, level_.groups.count()); ++group)
      tiles_computed += visit_group(group, bound, needed, scratch, [&](const Tile& tile) { take(g, tile); });
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

std::vector<Node> FineBounds::best_of_tiles(int first, int last, std::int64_t bound, std::size_t most) {
  std::vector<std::vector<Node>> found(static_cast<std::size_t>(last - first));
  visit_tiles(first, last, bound, 0, [&](std::size_t i, const Tile& tile) {
    const auto lane =
        static_cast<std::size_t>(std::max_element(tile.sums, tile.sums + tile_blocks) - tile.sums);
    found[i].push_back(make_node(tile.group, level_.layout.tiles[tile.index], lane,
                                 tile.largest + tile.unbounded * kernels::bound_levels));
  });
  std::vector<Node> all = joined(found);
  sort_nodes(all);
  if (all.size() > most) all.resize(most);
  return all;
}

std::vector<Node> FineBounds::survivors(int first, int last, std::int32_t lowest) {
  std::vector<std::vector<Node>> found(static_cast<std::size_t>(last - first));
  visit_tiles(first, last, table_units(lowest), table_units(lowest), [&](std::size_t i, const Tile& tile) {
    const std::uint16_t* allowed = level_.layout.allowed.data() + tile.index * tile_blocks;
    for (std::size_t lane = 0; lane < tile_blocks; ++lane)
      if (tile.sums[lane] >= tile.least && allowed[lane] != 0)
        found[i].push_back(make_node(tile.group, level_.layout.tiles[tile.index], lane,
                                     tile.sums[lane] + tile.unbounded * kernels::bound_levels));
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
