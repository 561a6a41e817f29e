#include "engine/methods/dense_bounds.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

#include "engine/parallel.hpp"

namespace landfall::internal {
namespace {

using kernels::tile_blocks;
using kernels::tile_cols;
using kernels::tile_rows;

constexpr std::size_t most_bounds = std::size_t{1} << 25;  // 64 MB

// Blocks where any heading has a pose.
BlockMask any_heading(const Domain& domain) {
  BlockMask any;
  const BlockMask* last = nullptr;
  for (const SharedMask& mask : domain.mask_of_heading) {
    if (mask == nullptr || mask.get() == last) continue;
    any = merged(any, *mask);
    last = mask.get();
  }
  return any;
}

}  // namespace

HeadingGroups choose_groups(const EndPoints& points, const Lattice& lattice) {
  constexpr double most_cells = 6.0;
  constexpr int most_headings = 16;
  double mean_cells = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i)
    mean_cells += std::hypot(points.x_cells[i], points.y_cells[i]);
  mean_cells /= static_cast<double>(points.size());
  const double headings = 1.0 + most_cells / std::max(1.0, mean_cells * lattice.heading_step_rad());
  const auto power = std::bit_floor(static_cast<unsigned>(std::min<double>(headings, most_headings)));
  return {.headings = lattice.headings, .per_group = static_cast<int>(power)};
}

DenseBounds::DenseBounds(const Query& query, const HeadingGroups& groups)
    : query_(query),
      groups_(groups),
      table_(query.map.bound_table()),
      unbounded_(static_cast<std::size_t>(groups.count())) {
  place_tiles();
}

// Rows of tiles, each begun at the next block that some heading may stand in.
void DenseBounds::place_tiles() {
  const BlockMask any = any_heading(query_.domain);
  for (int row = any.first_row; row < any.first_row + any.rows; row += tile_rows) {
    const auto used = [&](int col) {
      for (int r = row; r < row + tile_rows; ++r)
        if (any.at(col, r) != 0) return true;
      return false;
    };
    for (int col = any.first_col; col < any.first_col + any.cols; ++col) {
      if (!used(col)) continue;
      Tile tile{.col = col, .row = row, .lanes = {}};
      for (int i = 0; i < tile_blocks; ++i)
        tile.lanes[static_cast<std::size_t>(i)] =
            any.at(col + i % tile_cols, row + i / tile_cols) != 0 ? 0xFFFF : 0;
      tiles_.push_back(tile);
      col += tile_cols - 1;
    }
  }
}

int DenseBounds::groups_at_a_time() const {
  return static_cast<int>(
      std::max<std::size_t>(1, most_bounds / (std::max<std::size_t>(1, tiles_.size()) * tile_blocks)));
}

std::int64_t DenseBounds::compute(int first, int last, std::int32_t lowest) {
  first_ = first;
  last_ = last;
  const auto count = static_cast<std::size_t>(last - first);
  bounds_.resize(count * tiles_.size() * tile_blocks);
  largest_.assign(count * tiles_.size(), 0);
  parallel_for(count, query_.threads, [&](std::size_t g) {
    if (!query_.out_of_time()) compute_group(first + static_cast<int>(g), lowest);
  });
  return static_cast<std::int64_t>(bounds_.size());
}

void DenseBounds::compute_group(int group, std::int32_t lowest) {
  GroupPoints points;
  points.build(query_.points, query_.lattice, table_, groups_.first(group), groups_.last(group));
  unbounded_[static_cast<std::size_t>(group)] = points.unbounded();
  const int least = threshold(group, lowest);
  for (std::size_t t = 0; t < tiles_.size(); ++t) {
    const Tile& tile = tiles_[t];
    const std::size_t at = static_cast<std::size_t>(group - first_) * tiles_.size() + t;
    std::uint16_t* sums = bounds_.data() + at * tile_blocks;
    if (!kernels::bound_tile(table_.planes(), points.view(), tile.col, tile.row, least,
                             points.scratch().data(), sums))
      continue;
    std::uint16_t largest = 0;
    for (std::size_t i = 0; i < tile_blocks; ++i) {
      sums[i] = static_cast<std::uint16_t>(sums[i] & tile.lanes[i]);
      largest = std::max(largest, sums[i]);
    }
    largest_[at] = largest;
  }
}

// Sums from here on cannot be excluded: what the unbounded points may add is taken off.
int DenseBounds::threshold(int group, std::int32_t lowest) const {
  const std::int64_t unbounded = unbounded_[static_cast<std::size_t>(group)];
  return static_cast<int>(
      std::clamp<std::int64_t>(table_units(lowest) - unbounded * kernels::bound_levels, 0, 65535));
}

Node DenseBounds::node(std::size_t tile_index, std::size_t lane) const {
  const Tile& tile = tiles_[tile_index % tiles_.size()];
  const int group = first_ + static_cast<int>(tile_index / tiles_.size());
  const std::int32_t bound = bounds_[tile_index * tile_blocks + lane] +
                             unbounded_[static_cast<std::size_t>(group)] * kernels::bound_levels;
  return {.bound = static_cast<std::uint16_t>(std::min<std::int32_t>(bound, no_bound)),
          .group = static_cast<std::uint16_t>(group),
          .row = static_cast<std::uint16_t>(tile.row + static_cast<int>(lane) / tile_cols),
          .col = static_cast<std::uint16_t>(tile.col + static_cast<int>(lane) % tile_cols)};
}

std::vector<Node> DenseBounds::best_of_tiles(std::size_t count) const {
  std::vector<std::uint32_t> order(largest_.size());
  std::iota(order.begin(), order.end(), 0U);
  const auto end = order.begin() + static_cast<std::ptrdiff_t>(std::min(count, order.size()));
  std::partial_sort(order.begin(), end, order.end(), [this](std::uint32_t a, std::uint32_t b) {
    return largest_[a] != largest_[b] ? largest_[a] > largest_[b] : a < b;
  });
  std::vector<Node> best;
  for (auto at = order.begin(); at != end; ++at) {
    if (largest_[*at] == 0) break;
    const std::uint16_t* sums = bounds_.data() + std::size_t{*at} * tile_blocks;
    best.push_back(node(*at, static_cast<std::size_t>(std::max_element(sums, sums + tile_blocks) - sums)));
  }
  return best;
}

std::vector<Node> DenseBounds::survivors(std::int32_t lowest) const {
  std::vector<std::vector<Node>> found(static_cast<std::size_t>(last_ - first_));
  parallel_for(found.size(), query_.threads, [&](std::size_t g) {
    const int least = threshold(first_ + static_cast<int>(g), lowest);
    for (std::size_t t = 0; t < tiles_.size(); ++t) {
      const std::size_t at = g * tiles_.size() + t;
      if (largest_[at] < least) continue;
      const std::uint16_t* sums = bounds_.data() + at * tile_blocks;
      for (std::size_t lane = 0; lane < tile_blocks; ++lane)
        if (sums[lane] >= least && tiles_[t].lanes[lane] != 0) found[g].push_back(node(at, lane));
    }
  });
  std::vector<Node> all;
  for (const auto& some : found) all.insert(all.end(), some.begin(), some.end());
  return all;
}

}  // namespace landfall::internal
