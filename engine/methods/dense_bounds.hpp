// Bounds of many neighbouring blocks at a time, tiles of blocks x groups of headings, on two levels: blocks
// of 16 x 16 cells tell which tiles of blocks of 8 x 8 cells are worth bounding.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/methods/group_points.hpp"
#include "engine/methods/heading_groups.hpp"
#include "engine/query.hpp"
#include "engine/tile_layout.hpp"

namespace landfall::internal {

// A block of 8 x 8 cells for a group of headings, with an upper bound of its scores.
struct Node {
  std::uint16_t bound = 0;  // table units, see GroupPoints
  std::uint16_t group = 0;
  std::uint16_t row = 0;  // block
  std::uint16_t col = 0;
};
// The bound of a node that nobody computed.
inline constexpr std::uint16_t no_bound = 65535;

// What a level's bounds are computed from.
struct BoundLevel {
  const Query& query;
  const BoundTable& table;
  HeadingGroups groups;
  const TileLayout& layout;

  // The sum from which on a block's bound is at least `bound`, given points that no window bounds.
  static int least_sum(std::int64_t bound, std::int32_t unbounded);
};

// All bounds of some groups on the coarse level.
class CoarseBounds {
 public:
  explicit CoarseBounds(const BoundLevel& level) : level_(level) {}

  // So many groups fit into memory at a time; at least 1.
  [[nodiscard]] int groups_at_a_time() const;
  // Of groups [first, last). Bounds computed.
  std::int64_t compute(int first, int last);
  // The bound that so large a share of the tiles has a block of.
  [[nodiscard]] std::int64_t bound_of_best(double share_of_tiles) const;
  // Sets needed[tile_of_lane[...]] for every block of a group whose bound is at least `bound`. True: any.
  bool mark(int group, std::int64_t bound, std::span<const std::int32_t> tile_of_lane,
            std::vector<std::uint8_t>& needed) const;

 private:
  const BoundLevel& level_;
  int first_ = 0;
  std::vector<std::uint16_t> bounds_;    // [group - first][tile][lane]
  std::vector<std::uint16_t> largest_;   // [group - first][tile]
  std::vector<std::int32_t> unbounded_;  // [group - first]
};

// Blocks of 8 x 8 cells, in tiles that hold a coarse block of a given bound. Groups [first, last) are coarse
// ones; each holds two fine ones.
class FineBounds {
 public:
  FineBounds(const BoundLevel& level, const CoarseBounds& coarse, std::span<const std::int32_t> tile_of_lane)
      : level_(level),
        coarse_(coarse),
        tile_of_lane_(tile_of_lane),
        points_(static_cast<std::size_t>(level.groups.count())) {}

  // The best block of every tile and group that a coarse block of at least `bound` leads to; the best `most`
  // of them, best first.
  [[nodiscard]] std::vector<Node> best_of_tiles(int first, int last, std::int64_t bound, std::size_t most);
  // All blocks where a pose may reach `lowest`, as far as both levels tell.
  [[nodiscard]] std::vector<Node> survivors(int first, int last, std::int32_t lowest);

  std::int64_t bounds_computed = 0;

 private:
  struct Tile;
  template <class Take>
  std::int64_t visit_group(int group, std::int64_t bound, const std::vector<std::uint8_t>& needed,
                           std::vector<std::int32_t>& scratch, const Take& take);
  template <class Take>
  void visit_tiles(int first, int last, std::int64_t coarse_bound, std::int64_t bound, const Take& take);

  const BoundLevel& level_;
  const CoarseBounds& coarse_;
  std::span<const std::int32_t> tile_of_lane_;
  std::vector<GroupPoints> points_;  // [group], where built
};

// Best bound first.
void sort_nodes(std::vector<Node>& nodes);

}  // namespace landfall::internal
