// Nearest wall point within a cone of view, exactly. What lies before it cannot hide it: a point that
// did would be nearer. So the answer is a minimum over walls, each clipped to the cone.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "raycast/values.hpp"
#include "raycast/wedge.hpp"

namespace landfall::raycast {

struct Cone {
  double x_m, y_m, theta_rad;
  double half_angle_rad;  // in [0, pi)
  double range_max_m;
};

// The minimum over all walls, one by one: the oracle of the tree. +inf: none within range_max_m.
double nearest_in_cone(std::span<const Segment> walls, const Cone& cone);

// Bounding boxes of walls, halved at the median; searched nearer box first.
class SegmentTree {
 public:
  explicit SegmentTree(std::span<const Segment> walls);

  [[nodiscard]] double nearest_in_cone(const Cone& cone) const;
  [[nodiscard]] std::size_t memory_bytes() const;

 private:
  // Depth first: an inner node's left child follows it.
  struct Node {
    Box box;
    std::uint32_t next = 0;   // leaf: its first wall; inner node: its right child
    std::uint32_t walls = 0;  // of a leaf; 0: inner node
  };

  void build(std::size_t begin, std::size_t end);
  // The least of `best` and the squared distance of any wall below the node; `bound`: the node's own bound.
  [[nodiscard]] double nearest(const Wedge& wedge, std::size_t node, double bound, double best) const;

  std::vector<Segment> walls_;
  std::vector<Node> nodes_;
};

}  // namespace landfall::raycast
