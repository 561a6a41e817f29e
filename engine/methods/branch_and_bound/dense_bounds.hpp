// Bounds of many neighbouring blocks at a time, tiles of blocks x groups of headings, on two levels: blocks
// of 16 x 16 cells tell which tiles of blocks of 8 x 8 cells are worth bounding.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/methods/branch_and_bound/group_points.hpp"
#include "engine/methods/branch_and_bound/heading_groups.hpp"
#include "engine/priors/tile_layout.hpp"
#include "engine/query.hpp"

namespace landfall::internal {

// Blocks of 8 x 8 cells in a tile, for a group of headings, with an upper bound of their scores.
struct Node {
  std::uint64_t lanes = 0;  // bit per block, see kernels::tile_lane
  std::uint16_t bound = 0;  // table units, see GroupPoints
  std::uint16_t group = 0;
  std::uint16_t row = 0;  // of the tile's first block
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

// Which coarse blocks: those of at least this bound. Of the tiles that have no more than just that, one in so
// many: where bounds are saturated, most tiles have.
struct CoarseChoice {
  std::int64_t bound = 0;
  std::size_t one_in = 1;
};

// All bounds of some groups on the coarse level.
class CoarseBounds {
 public:
  explicit CoarseBounds(const BoundLevel& level) : level_(level) {}

  // So many groups fit into memory at a time; at least 1.
  [[nodiscard]] int groups_at_a_time() const;
  // Of groups [first, last); what lies below `bound` may be given up. Bounds computed.
  std::int64_t compute(int first, int last, std::int64_t bound);
  // So large a share of the tiles, the best ones.
  [[nodiscard]] CoarseChoice best(double share_of_tiles) const;
  // Adds the parts of every chosen block of a group to needed[fine tile]. True: any.
  bool mark(int group, const CoarseChoice& choice, std::span<const SearchTiles::Parts> parts,
            std::vector<std::uint64_t>& needed) const;

 private:
  const BoundLevel& level_;
  int first_ = 0;
  std::int64_t least_bound_ = 0;         // bounds below it are not known
  std::vector<std::uint16_t> bounds_;    // [group - first][tile][lane]
  std::vector<std::uint16_t> largest_;   // [group - first][tile]
  std::vector<std::int32_t> unbounded_;  // [group - first]
};

// Blocks of 8 x 8 cells that are parts of a coarse block of a given bound. Groups [first, last) are coarse
// ones; each holds two fine ones.
class FineBounds {
 public:
  FineBounds(const BoundLevel& level, const CoarseBounds& coarse, std::span<const SearchTiles::Parts> parts)
      : level_(level),
        coarse_(coarse),
        parts_(parts),
        points_(static_cast<std::size_t>(level.groups.count())) {}

  // The best block of every tile and group that the chosen coarse blocks lead to; the best `most` of these
  // blocks, best first.
  [[nodiscard]] std::vector<Node> best_of_tiles(int first, int last, const CoarseChoice& choice,
                                                std::size_t most);
  // All blocks where a pose may reach `lowest`, as far as both levels tell, by tile.
  [[nodiscard]] std::vector<Node> survivors(int first, int last, std::int32_t lowest);

  std::int64_t bounds_computed = 0;

 private:
  struct Tile;
  template <class Take>
  std::int64_t visit_group(int group, std::int64_t bound, std::span<const std::uint64_t> needed,
                           const Take& take);
  template <class Take>
  void visit_tiles(int first, int last, const CoarseChoice& choice, std::int64_t bound, const Take& take);

  const BoundLevel& level_;
  const CoarseBounds& coarse_;
  std::span<const SearchTiles::Parts> parts_;
  std::vector<GroupPoints> points_;  // [group], where built
};

// Best bound first.
void sort_nodes(std::vector<Node>& nodes);

}  // namespace landfall::internal
