// The particle swarm of Okada & Fujimoto (Grid-based Localization and Mapping Method without Odometry
// Information), section II.B.2, steps 0 to 4. Changed: a fit is counted up, which is their f turned over.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "landfall/slam.hpp"

namespace landfall::internal {

struct Particle {
  Eigen::Vector3d z = Eigen::Vector3d::Zero();  // (x_m, y_m, theta_rad)
  Eigen::Vector3d v = Eigen::Vector3d::Zero();
  Eigen::Vector3d own_best = Eigen::Vector3d::Zero();  // pbest
  std::int32_t own_fit = 0;
};

// Equations 4 and 5 with the diagonals of R_1 and R_2.
void move(Particle& particle, const Eigen::Vector3d& swarm_best, const SwarmOptions& options,
          const Eigen::Vector3d& r1, const Eigen::Vector3d& r2);

// The published start: particles along x, along y and turned on the spot, evenly over the reach.
std::vector<Eigen::Vector3d> start_pattern(const SwarmOptions& options);

struct Flight {
  std::vector<Particle> particles;
  Eigen::Vector3d best = Eigen::Vector3d::Zero();  // gbest
  std::int32_t fit = 0;
  int iterations = 0;
  std::int64_t poses_scored = 0;
};

// Random numbers of a flight depend on these alone.
struct FlightKey {
  std::uint64_t seed = 0;
  std::uint32_t scan = 0;
  std::uint32_t flight = 0;
};

// Data_fit(z), 0 to valid.
using Fit = std::function<std::int32_t(const Eigen::Vector3d&)>;

// From the start until f is below options.good_enough or for options.iterations; `done`, where given, ends it
// too. Of equal fits the earlier one stays.
Flight fly(std::span<const Eigen::Vector3d> start, std::int32_t valid, const Fit& fit,
           const SwarmOptions& options, const FlightKey& key, const std::function<bool()>& done = {});

}  // namespace landfall::internal
