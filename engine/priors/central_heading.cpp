#include "engine/priors/central_heading.hpp"

#include <cmath>
#include <numbers>
#include <optional>

namespace landfall::internal {
namespace {

struct CentralHeading {
  std::optional<double> operator()(const Window& window) const {
    return of_cone(window.T_map_robot.theta_rad, window.half_theta_rad);
  }
  std::optional<double> operator()(const Gaussian& gaussian) const { return gaussian.T_map_robot.theta_rad; }
  std::optional<double> operator()(const Region& region) const {
    return of_cone(region.theta_rad, region.half_theta_rad);
  }
  template <class Other>
  std::optional<double> operator()(const Other& /*other*/) const {
    return std::nullopt;
  }

  static std::optional<double> of_cone(double theta_rad, double half_theta_rad) {
    if (half_theta_rad >= std::numbers::pi) return std::nullopt;
    return theta_rad;
  }
};

}  // namespace

Lattice centered_on(const PosePrior& prior, Lattice lattice) {
  const std::optional<double> theta_rad = std::visit(CentralHeading{}, prior.kind);
  if (theta_rad)
    lattice.first_heading_rad =
        std::remainder(*theta_rad - lattice.T_map_grid.theta_rad, lattice.heading_step_rad());
  return lattice;
}

}  // namespace landfall::internal
