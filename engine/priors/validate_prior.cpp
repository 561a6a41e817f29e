#include <Eigen/Dense>
#include <cmath>
#include <string>

#include "engine/base/number_text.hpp"
#include "landfall/error.hpp"
#include "landfall/prior.hpp"

namespace landfall {
namespace {

[[noreturn]] void fail(const std::string& field, const std::string& found, const std::string& expected) {
  throw Error(ErrorCode::invalid_argument, "prior: " + field + " is " + found + ", expected " + expected);
}

void require_finite(const char* field, double value) {
  if (!std::isfinite(value)) fail(field, number_text(value), "a finite number");
}

void require_width(const char* field, double value) {
  if (!std::isfinite(value) || value < 0.0) fail(field, number_text(value), "a number that is not negative");
}

void require_pose(const char* field, const Pose2& pose) {
  if (!is_finite(pose)) fail(field, pose_text(pose), "finite numbers");
}

void check(const Anywhere&, int) {}

void check(const Window& window, int) {
  require_pose("window.T_map_robot", window.T_map_robot);
  require_width("window.half_x_m", window.half_x_m);
  require_width("window.half_y_m", window.half_y_m);
  require_width("window.half_theta_rad", window.half_theta_rad);
}

void check(const Gaussian& gaussian, int) {
  require_pose("gaussian.T_map_robot", gaussian.T_map_robot);
  for (const double value : gaussian.covariance) require_finite("gaussian.covariance", value);
  const Eigen::Matrix3d covariance = Eigen::Map<const Eigen::Matrix3d>(gaussian.covariance.data());
  const double scale = covariance.cwiseAbs().maxCoeff();
  if ((covariance - covariance.transpose()).cwiseAbs().maxCoeff() > 1e-9 * scale)
    fail("gaussian.covariance", "not symmetric", "a symmetric matrix");
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(covariance, Eigen::EigenvaluesOnly);
  if (solver.eigenvalues()[0] < -1e-9 * scale)
    fail("gaussian.covariance", "a matrix with eigenvalue " + number_text(solver.eigenvalues()[0]),
         "a positive semi-definite one");
}

void check(const Region& region, int) {
  if (region.polygon_map.size() < 3)
    fail("region.polygon_map", std::to_string(region.polygon_map.size()) + " corners", "at least 3");
  for (const Point2& corner : region.polygon_map) {
    require_finite("region.polygon_map", corner.x_m);
    require_finite("region.polygon_map", corner.y_m);
  }
  require_finite("region.theta_rad", region.theta_rad);
  require_width("region.half_theta_rad", region.half_theta_rad);
}

void check(const Beacons& beacons, int) {
  if (beacons.discs.empty()) fail("beacons", "empty", "at least one disc");
  for (const Beacon& disc : beacons.discs) {
    require_finite("beacons.p_map", disc.p_map.x_m);
    require_finite("beacons.p_map", disc.p_map.y_m);
    require_width("beacons.radius_m", disc.radius_m);
  }
}

void check(const CandidatePoses& candidates, int) {
  if (candidates.T_map_robot.empty()) fail("poses", "empty", "at least one pose");
  for (const Pose2& pose : candidates.T_map_robot) require_pose("poses", pose);
}

void check_nested(const PosePrior& prior, int depth);

void check(const Mixture& mixture, int depth) {
  constexpr int max_depth = 8;
  if (depth >= max_depth) fail("mixture", "nested deeper than " + std::to_string(max_depth), "less");
  if (mixture.components.empty()) fail("mixture", "empty", "at least one component");
  if (mixture.components.size() != mixture.weights.size())
    fail("mixture.weights", std::to_string(mixture.weights.size()) + " numbers",
         std::to_string(mixture.components.size()) + ", one per component");
  double total = 0.0;
  for (const double weight : mixture.weights) {
    require_width("mixture.weights", weight);
    total += weight;
  }
  if (!(total > 0.0)) fail("mixture.weights", "a sum of 0", "a positive sum");
  for (const PosePrior& component : mixture.components) check_nested(component, depth + 1);
}

void check_nested(const PosePrior& prior, int depth) {
  std::visit([depth](const auto& kind) { check(kind, depth); }, prior.kind);
}

}  // namespace

void validate(const PosePrior& prior) {
  check_nested(prior, 0);
}

}  // namespace landfall
