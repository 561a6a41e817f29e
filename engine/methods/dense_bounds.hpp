// Bounds of many neighbouring blocks at a time: tiles of blocks x groups of headings.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "engine/methods/group_points.hpp"
#include "engine/query.hpp"
#include "kernels/bound_tile.hpp"

namespace landfall::internal {

// A block of 8 x 8 cells for a group of headings, with an upper bound of its scores.
struct Node {
  std::uint16_t bound = 0;  // table units, see GroupPoints
  std::uint16_t group = 0;
  std::uint16_t row = 0;  // block
  std::uint16_t col = 0;
};
struct PromisesMore {
  bool operator()(const Node& a, const Node& b) const { return a.bound > b.bound; }
};
// The bound of a node that nobody computed.
inline constexpr std::uint16_t no_bound = 65535;

// Neighbouring headings that are bounded together.
struct HeadingGroups {
  int headings = 0;  // of the lattice
  int per_group = 1;

  [[nodiscard]] int count() const { return (headings + per_group - 1) / per_group; }
  [[nodiscard]] int first(int group) const { return group * per_group; }
  [[nodiscard]] int last(int group) const { return std::min(headings, (group + 1) * per_group); }
};

// Groups so wide that a typical end point moves by about half a block over one.
HeadingGroups choose_groups(const EndPoints& points, const Lattice& lattice);

// The bounds of groups [first, last) over all tiles that hold a cell of the prior.
class DenseBounds {
 public:
  DenseBounds(const Query& query, const HeadingGroups& groups);

  // So many groups fit into memory at a time; at least 1.
  [[nodiscard]] int groups_at_a_time() const;
  // Computes them; tiles in which no pose can reach `lowest` are given up. Bounds computed.
  std::int64_t compute(int first, int last, std::int32_t lowest);
  // The best block of each of the `count` best tiles, best first.
  [[nodiscard]] std::vector<Node> best_of_tiles(std::size_t count) const;
  // All blocks where a pose may reach `lowest`.
  [[nodiscard]] std::vector<Node> survivors(std::int32_t lowest) const;

 private:
  struct Tile {
    int col;  // block
    int row;
    std::array<std::uint16_t, kernels::tile_blocks> lanes;  // all ones where some heading may stand
  };
  void place_tiles();
  void compute_group(int group, std::int32_t lowest);
  [[nodiscard]] Node node(std::size_t tile_index, std::size_t lane) const;
  [[nodiscard]] int threshold(int group, std::int32_t lowest) const;

  const Query& query_;
  const HeadingGroups& groups_;
  const BoundTable& table_;
  std::vector<Tile> tiles_;
  int first_ = 0;
  int last_ = 0;
  std::vector<std::uint16_t> bounds_;    // [group - first][tile][block]
  std::vector<std::uint16_t> largest_;   // [group - first][tile]; 0: given up
  std::vector<std::int32_t> unbounded_;  // [group]: points that no window bounds
};

}  // namespace landfall::internal
