// Iterative closest point (equation 1 of Okada & Fujimoto; Besl & McKay 1992, A Method for Registration of
// 3-D Shapes; point to line: Chen & Medioni 1992). Closest points from nanoflann's k-d tree.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "landfall/pose2.hpp"

namespace landfall::internal {

struct IcpOptions {
  bool to_line = false;
  int iterations = 50;
  double reach_m = 0.5;  // points farther apart are not matched
};

// The points that others are matched to, with the normals of the lines through their neighbours.
class IcpTarget {
 public:
  explicit IcpTarget(std::vector<Point2> points, bool with_normals);
  ~IcpTarget();
  IcpTarget(IcpTarget&&) noexcept;
  IcpTarget& operator=(IcpTarget&&) noexcept;

  [[nodiscard]] std::size_t size() const;
  [[nodiscard]] std::size_t memory_bytes() const;
  // T_fixed_moving from a start near it; the start where too few points have one within reach.
  [[nodiscard]] Pose2 match(std::span<const Point2> moving, const Pose2& T_fixed_start,
                            const IcpOptions& options) const;

 private:
  struct Tree;
  std::unique_ptr<Tree> tree_;
};

}  // namespace landfall::internal
