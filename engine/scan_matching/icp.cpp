#include "engine/scan_matching/icp.hpp"

#include <Eigen/Dense>
#include <cmath>
#include <nanoflann.hpp>
#include <numeric>
#include <optional>
#include <utility>

#include "engine/align/twist.hpp"
#include "engine/base/rigid.hpp"

namespace landfall::internal {
namespace {

constexpr std::size_t line_neighbours = 8;
constexpr double roundest_line = 0.1;  // spread across over spread along, squared
constexpr double settled = 1e-5;       // metres and radians
constexpr std::size_t least_points = 3;

// What nanoflann asks of a set of points.
struct Cloud {
  std::vector<Point2> points;
  [[nodiscard]] std::size_t kdtree_get_point_count() const { return points.size(); }
  [[nodiscard]] double kdtree_get_pt(std::size_t i, std::size_t axis) const {
    return axis == 0 ? points[i].x_m : points[i].y_m;
  }
  template <class Box>
  bool kdtree_get_bbox(Box& /*box*/) const {
    return false;
  }
};

using Index =
    nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, Cloud>, Cloud, 2, std::size_t>;

struct Pair {
  Point2 moving;  // in the fixed frame
  std::size_t fixed;
};

// The motion that takes the moving points onto the fixed ones, least squares: equation 1 solved.
Eigen::Vector3d point_to_point(std::span<const Pair> pairs, std::span<const Point2> fixed) {
  Eigen::Vector2d mean_moving = Eigen::Vector2d::Zero();
  Eigen::Vector2d mean_fixed = Eigen::Vector2d::Zero();
  for (const Pair& pair : pairs) {
    mean_moving += Eigen::Vector2d(pair.moving.x_m, pair.moving.y_m);
    mean_fixed += Eigen::Vector2d(fixed[pair.fixed].x_m, fixed[pair.fixed].y_m);
  }
  mean_moving /= static_cast<double>(pairs.size());
  mean_fixed /= static_cast<double>(pairs.size());
  double cross = 0.0;
  double dot = 0.0;
  for (const Pair& pair : pairs) {
    const Eigen::Vector2d a = Eigen::Vector2d(pair.moving.x_m, pair.moving.y_m) - mean_moving;
    const Eigen::Vector2d b = Eigen::Vector2d(fixed[pair.fixed].x_m, fixed[pair.fixed].y_m) - mean_fixed;
    cross += a.x() * b.y() - a.y() * b.x();
    dot += a.dot(b);
  }
  const double theta = std::atan2(cross, dot);
  const Eigen::Vector2d t = mean_fixed - Eigen::Rotation2Dd(theta) * mean_moving;
  return {t.x(), t.y(), theta};
}

}  // namespace

struct IcpTarget::Tree {
  Cloud cloud;
  std::vector<std::optional<Point2>> normals;  // empty, or one per point
  Index index;

  explicit Tree(std::vector<Point2> points)
      : cloud{std::move(points)}, index(2, cloud, nanoflann::KDTreeSingleIndexAdaptorParams(10)) {}

  [[nodiscard]] std::optional<Point2> normal_at(std::size_t i) const {
    const double query[2] = {cloud.points[i].x_m, cloud.points[i].y_m};
    std::size_t near[line_neighbours];
    double squared[line_neighbours];
    const std::size_t found = index.knnSearch(query, line_neighbours, near, squared);
    if (found < least_points) return std::nullopt;
    Eigen::Vector2d mean = Eigen::Vector2d::Zero();
    for (std::size_t k = 0; k < found; ++k)
      mean += Eigen::Vector2d(cloud.points[near[k]].x_m, cloud.points[near[k]].y_m);
    mean /= static_cast<double>(found);
    Eigen::Matrix2d spread = Eigen::Matrix2d::Zero();
    for (std::size_t k = 0; k < found; ++k) {
      const Eigen::Vector2d d = Eigen::Vector2d(cloud.points[near[k]].x_m, cloud.points[near[k]].y_m) - mean;
      spread += d * d.transpose();
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(spread);
    if (axes.eigenvalues()[0] > roundest_line * axes.eigenvalues()[1]) return std::nullopt;
    return Point2{.x_m = axes.eigenvectors()(0, 0), .y_m = axes.eigenvectors()(1, 0)};
  }

  [[nodiscard]] std::vector<Pair> closest(std::span<const Point2> moving, const Pose2& T_fixed_moving,
                                          double reach_m) const {
    const Rigid to_fixed(T_fixed_moving);
    std::vector<Pair> pairs;
    for (const Point2& p_moving : moving) {
      const Point2 p = to_fixed.point(p_moving);
      const double query[2] = {p.x_m, p.y_m};
      std::size_t near = 0;
      double squared = 0.0;
      if (index.knnSearch(query, 1, &near, &squared) == 1 && squared <= reach_m * reach_m)
        pairs.push_back({.moving = p, .fixed = near});
    }
    return pairs;
  }

  // One Gauss-Newton step; points whose neighbours form no line are left out.
  [[nodiscard]] Eigen::Vector3d point_to_line(std::span<const Pair> pairs) const {
    Eigen::Matrix3d hessian = Eigen::Matrix3d::Identity() * 1e-9;
    Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
    for (const Pair& pair : pairs) {
      const std::optional<Point2>& n = normals[pair.fixed];
      if (!n) continue;
      const Point2& p = pair.moving;
      const Point2& q = cloud.points[pair.fixed];
      const Eigen::Vector3d j(n->x_m, n->y_m, n->y_m * p.x_m - n->x_m * p.y_m);
      const double residual = n->x_m * (p.x_m - q.x_m) + n->y_m * (p.y_m - q.y_m);
      hessian += j * j.transpose();
      gradient += residual * j;
    }
    return -hessian.ldlt().solve(gradient);
  }
};

IcpTarget::IcpTarget(std::vector<Point2> points, bool with_normals)
    : tree_(std::make_unique<Tree>(std::move(points))) {
  if (!with_normals) return;
  for (std::size_t i = 0; i < size(); ++i) tree_->normals.push_back(tree_->normal_at(i));
}
IcpTarget::~IcpTarget() = default;
IcpTarget::IcpTarget(IcpTarget&&) noexcept = default;
IcpTarget& IcpTarget::operator=(IcpTarget&&) noexcept = default;

std::size_t IcpTarget::size() const {
  return tree_->cloud.points.size();
}
std::size_t IcpTarget::memory_bytes() const {
  return sizeof(Point2) * tree_->cloud.points.capacity() + tree_->index.usedMemory(tree_->index) +
         sizeof(std::optional<Point2>) * tree_->normals.capacity();
}

Pose2 IcpTarget::match(std::span<const Point2> moving, const Pose2& T_fixed_start,
                       const IcpOptions& options) const {
  Pose2 T_fixed_moving = T_fixed_start;
  if (size() == 0) return T_fixed_moving;
  for (int i = 0; i < options.iterations; ++i) {
    const std::vector<Pair> pairs = tree_->closest(moving, T_fixed_moving, options.reach_m);
    if (pairs.size() < least_points) break;
    const Eigen::Vector3d motion =
        options.to_line ? tree_->point_to_line(pairs) : point_to_point(pairs, tree_->cloud.points);
    if (!motion.allFinite()) break;
    T_fixed_moving = moved(motion, T_fixed_moving);
    if (motion.cwiseAbs().maxCoeff() < settled) break;
  }
  return T_fixed_moving;
}

}  // namespace landfall::internal
