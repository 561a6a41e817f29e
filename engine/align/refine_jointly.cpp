#include "engine/align/refine_jointly.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/align/point_to_line.hpp"
#include "engine/align/twist.hpp"

namespace landfall::internal {
namespace {

constexpr int most_iterations = 15;
constexpr double first_gate_m = 0.4;
constexpr double last_gate_m = 0.2;
constexpr double gate_decay = 0.7;
constexpr double settled = 1e-4;  // metres and radians
// Scans farther apart in the window are not matched.
constexpr std::size_t most_apart = 4;

Eigen::Index row_of(std::size_t scan) {
  return 3 * static_cast<Eigen::Index>(scan);
}

class Problem {
 public:
  explicit Problem(const ScanWindow& window)
      : window_(window),
        size_(row_of(window.scans.size())),
        hessian_(Eigen::MatrixXd::Zero(size_, size_)),
        gradient_(Eigen::VectorXd::Zero(size_)) {}

  void add_matches(const std::vector<Pose2>& poses, double gate_m) {
    // A scan that is matched to many others is told the same many times.
    const std::size_t partners = std::min(window_.scans.size() - 1, most_apart);
    const double weight = 2.0 / static_cast<double>(partners + 1);
    for (std::size_t a = 0; a < window_.scans.size(); ++a)
      for (std::size_t b = a + 1; b < window_.scans.size() && b - a <= most_apart; ++b) {
        add_match(poses, a, b, weight, gate_m);
        add_match(poses, b, a, weight, gate_m);
      }
  }

  void add_odometry(const std::vector<Pose2>& poses) {
    for (std::size_t k = 0; k < window_.steps.size(); ++k) {
      const OdometryStep& step = window_.steps[k];
      const Eigen::Matrix3d jacobian = relative_jacobian(poses[k], poses[k + 1]);
      const Eigen::Vector3d off = difference(inverse(poses[k]) * poses[k + 1], step.T_before_after);
      const double t = 1.0 / (step.sigma.translation_m * step.sigma.translation_m);
      const double r = 1.0 / (step.sigma.rotation_rad * step.sigma.rotation_rad);
      const Eigen::Matrix3d weighted = jacobian.transpose() * Eigen::Vector3d(t, t, r).asDiagonal();
      add(k, k + 1, weighted * jacobian, weighted * off);
    }
  }

  [[nodiscard]] const Eigen::MatrixXd& hessian() const { return hessian_; }

  // The motions that bring the gradient to zero; the reference's is zero.
  [[nodiscard]] Eigen::VectorXd solve() {
    hold_scan(window_.reference, hessian_);
    gradient_.segment<3>(row_of(window_.reference)).setZero();
    return -hessian_.ldlt().solve(gradient_);
  }

 private:
  void add_match(const std::vector<Pose2>& poses, std::size_t moving, std::size_t fixed, double weight,
                 double gate_m) {
    const Pose2 T_fixed_reference = inverse(poses[fixed]);
    const PairNormal pair = point_to_line(*window_.scans[fixed], *window_.scans[moving],
                                          T_fixed_reference * poses[moving], gate_m);
    const Eigen::Matrix3d to_fixed = adjoint(T_fixed_reference);
    const Eigen::Matrix3d weighted = weight * to_fixed.transpose();
    add(fixed, moving, weighted * pair.hessian * to_fixed, weighted * pair.gradient);
  }

  // A residual of d_after - d_before.
  void add(std::size_t before, std::size_t after, const Eigen::Matrix3d& hessian,
           const Eigen::Vector3d& gradient) {
    const Eigen::Index b = row_of(before);
    const Eigen::Index a = row_of(after);
    hessian_.block<3, 3>(a, a) += hessian;
    hessian_.block<3, 3>(b, b) += hessian;
    hessian_.block<3, 3>(a, b) -= hessian;
    hessian_.block<3, 3>(b, a) -= hessian;
    gradient_.segment<3>(a) += gradient;
    gradient_.segment<3>(b) -= gradient;
  }

  const ScanWindow& window_;
  Eigen::Index size_;
  Eigen::MatrixXd hessian_;
  Eigen::VectorXd gradient_;
};

}  // namespace

void hold_scan(std::size_t scan, Eigen::MatrixXd& hessian) {
  const Eigen::Index at = row_of(scan);
  hessian.middleRows<3>(at).setZero();
  hessian.middleCols<3>(at).setZero();
  hessian.block<3, 3>(at, at).setIdentity();
}

RefinedWindow refine_jointly(const ScanWindow& window, std::vector<Pose2> T_reference_start) {
  RefinedWindow refined{.T_reference_robot = std::move(T_reference_start), .information = {}};
  std::vector<Pose2>& poses = refined.T_reference_robot;
  double gate_m = first_gate_m;
  for (int i = 0; i < most_iterations; ++i) {
    Problem problem(window);
    problem.add_matches(poses, gate_m);
    refined.information = problem.hessian();
    problem.add_odometry(poses);
    const Eigen::VectorXd motion = problem.solve();
    if (!motion.allFinite()) break;
    for (std::size_t k = 0; k < poses.size(); ++k) poses[k] = moved(motion.segment<3>(row_of(k)), poses[k]);
    if (gate_m == last_gate_m && motion.cwiseAbs().maxCoeff() < settled) break;
    gate_m = std::max(last_gate_m, gate_decay * gate_m);
  }
  return refined;
}

}  // namespace landfall::internal
