// Where to look: what is known of the robot's pose before the scan is read. All in the map frame.
#pragma once

#include <array>
#include <numbers>
#include <variant>
#include <vector>

#include "landfall/pose2.hpp"

namespace landfall {

// Everywhere that is free, any heading.
struct Anywhere {};

// A box in x and y and a cone in heading around T_map_robot; half widths. The box is aligned with
// the map's axes.
struct Window {
  Pose2 T_map_robot;
  double half_x_m = 0.5;
  double half_y_m = 0.5;
  double half_theta_rad = std::numbers::pi;
};

// Support: three sigma (Mahalanobis distance in x, y, theta at most 3).
struct Gaussian {
  Pose2 T_map_robot;
  std::array<double, 9> covariance{};  // of (x_m, y_m, theta_rad), row by row
};

// A simple polygon, any heading or a cone of headings.
struct Region {
  std::vector<Point2> polygon_map;
  double theta_rad = 0.0;
  double half_theta_rad = std::numbers::pi;
};

// The robot is within radius_m of one of the centres; any heading.
struct Beacon {
  Point2 p_map;
  double radius_m = 1.0;
};
struct Beacons {
  std::vector<Beacon> discs;
};

// Each pose stands for the lattice pose nearest to it.
struct CandidatePoses {
  std::vector<Pose2> T_map_robot;
};

struct PosePrior;
// Weights multiply the likelihood in `probability`; they never enter `score`. They need not sum to 1.
struct Mixture {
  std::vector<double> weights;
  std::vector<PosePrior> components;
};

struct PosePrior {
  std::variant<Anywhere, Window, Gaussian, Region, Beacons, CandidatePoses, Mixture> kind;
};

// Throws Error{invalid_argument} that names the field: values that are not finite, negative widths
// or weights, a covariance that is not symmetric positive semi-definite, fewer than three corners,
// empty lists, weights and components of different number, mixtures nested deeper than 8.
void validate(const PosePrior& prior);

}  // namespace landfall
