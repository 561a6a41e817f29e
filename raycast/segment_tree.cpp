#include "raycast/segment_tree.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace landfall::raycast {
namespace {

constexpr std::size_t max_leaf_walls = 4;
constexpr double infinity = std::numeric_limits<double>::infinity();

// Distance to the nearest point in the cone's one or two convex wedges. least(wedge, best): the least of
// `best` and the squared distances of all walls in the wedge.
template <typename Least>
double over_wedges(const Cone& cone, Least least) {
  const double beyond = std::nextafter(cone.range_max_m * cone.range_max_m, infinity);
  double best = beyond;
  if (cone.half_angle_rad <= std::numbers::pi / 2.0) {
    best = least(Wedge(cone.x_m, cone.y_m, cone.theta_rad, cone.half_angle_rad), best);
  } else {
    const double half_rad = cone.half_angle_rad / 2.0;
    best = least(Wedge(cone.x_m, cone.y_m, cone.theta_rad - half_rad, half_rad), best);
    best = least(Wedge(cone.x_m, cone.y_m, cone.theta_rad + half_rad, half_rad), best);
  }
  return best < beyond ? std::sqrt(best) : infinity;
}

}  // namespace

double nearest_in_cone(std::span<const Segment> walls, const Cone& cone) {
  return over_wedges(cone, [&](const Wedge& wedge, double best) {
    for (const Segment& wall : walls) best = std::min(best, wedge.squared_distance(wall));
    return best;
  });
}

SegmentTree::SegmentTree(std::span<const Segment> walls) : walls_(walls.begin(), walls.end()) {
  if (!walls_.empty()) build(0, walls_.size());
}

void SegmentTree::build(std::size_t begin, std::size_t end) {
  const std::size_t node = nodes_.size();
  nodes_.emplace_back();
  Box box;
  for (std::size_t i = begin; i < end; ++i) box.add(walls_[i]);
  nodes_[node].box = box;
  if (end - begin <= max_leaf_walls) {
    nodes_[node].next = static_cast<std::uint32_t>(begin);
    nodes_[node].walls = static_cast<std::uint32_t>(end - begin);
    return;
  }
  const bool split_x = box.max_x_m - box.min_x_m >= box.max_y_m - box.min_y_m;
  const auto twice_center = [split_x](const Segment& wall) {
    return split_x ? wall.ax_m + wall.bx_m : wall.ay_m + wall.by_m;
  };
  const std::size_t middle = begin + (end - begin) / 2;
  const auto at = [this](std::size_t i) { return walls_.begin() + static_cast<std::ptrdiff_t>(i); };
  std::nth_element(at(begin), at(middle), at(end),
                   [&](const Segment& a, const Segment& b) { return twice_center(a) < twice_center(b); });
  build(begin, middle);
  nodes_[node].next = static_cast<std::uint32_t>(nodes_.size());
  build(middle, end);
}

double SegmentTree::nearest(const Wedge& wedge, std::size_t node, double bound, double best) const {
  if (bound >= best) return best;
  const Node& here = nodes_[node];
  if (here.walls > 0) {
    for (std::size_t i = here.next; i < here.next + here.walls; ++i)
      best = std::min(best, wedge.squared_distance(walls_[i]));
    return best;
  }
  std::size_t near = node + 1;
  std::size_t far = here.next;
  double near_bound = wedge.squared_lower_bound(nodes_[near].box);
  double far_bound = wedge.squared_lower_bound(nodes_[far].box);
  if (far_bound < near_bound) {
    std::swap(near, far);
    std::swap(near_bound, far_bound);
  }
  best = nearest(wedge, near, near_bound, best);
  return nearest(wedge, far, far_bound, best);
}

double SegmentTree::nearest_in_cone(const Cone& cone) const {
  if (nodes_.empty()) return infinity;
  return over_wedges(cone, [&](const Wedge& wedge, double best) {
    return nearest(wedge, 0, wedge.squared_lower_bound(nodes_[0].box), best);
  });
}

std::size_t SegmentTree::memory_bytes() const {
  return walls_.capacity() * sizeof(Segment) + nodes_.capacity() * sizeof(Node);
}

}  // namespace landfall::raycast
