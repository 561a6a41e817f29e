#include "engine/methods/pso/swarm.hpp"

#include "engine/base/counter_rng.hpp"

namespace landfall::internal {
namespace {

Eigen::Vector3d draw(CounterRng& rng) {
  const double x = rng.uniform();
  const double y = rng.uniform();
  const double theta = rng.uniform();
  return {x, y, theta};
}

// Evenly from -reach to reach.
double spread(int index, int count, double reach) {
  return count < 2 ? 0.0 : reach * (2.0 * index / (count - 1) - 1.0);
}

void remember_swarm_best(Flight& flight) {
  for (const Particle& particle : flight.particles) {
    if (particle.own_fit <= flight.fit) continue;
    flight.fit = particle.own_fit;
    flight.best = particle.own_best;
  }
}

Flight initialize(std::span<const Eigen::Vector3d> start, const Fit& fit) {
  Flight flight;
  for (const Eigen::Vector3d& z : start) {
    flight.particles.push_back({.z = z, .own_best = z, .own_fit = fit(z)});
    ++flight.poses_scored;
  }
  if (!start.empty()) {
    flight.best = start.front();
    flight.fit = flight.particles.front().own_fit;
  }
  remember_swarm_best(flight);
  return flight;
}

void evaluate(Flight& flight, const Fit& fit) {
  for (Particle& particle : flight.particles) {
    const std::int32_t here = fit(particle.z);
    if (here <= particle.own_fit) continue;
    particle.own_fit = here;
    particle.own_best = particle.z;
  }
  flight.poses_scored += static_cast<std::int64_t>(flight.particles.size());
}

}  // namespace

void move(Particle& particle, const Eigen::Vector3d& swarm_best, const SwarmOptions& options,
          const Eigen::Vector3d& r1, const Eigen::Vector3d& r2) {
  particle.v = options.inertia * particle.v +
               options.own_pull * r1.cwiseProduct(particle.own_best - particle.z) +
               options.swarm_pull * r2.cwiseProduct(swarm_best - particle.z);
  particle.z += particle.v;
}

std::vector<Eigen::Vector3d> start_pattern(const SwarmOptions& options) {
  const int along = options.particles / 4;
  const int turned = options.particles - 2 * along;
  std::vector<Eigen::Vector3d> start;
  start.reserve(static_cast<std::size_t>(options.particles));
  for (int i = 0; i < along; ++i) start.emplace_back(spread(i, along, options.reach_m), 0.0, 0.0);
  for (int i = 0; i < along; ++i) start.emplace_back(0.0, spread(i, along, options.reach_m), 0.0);
  for (int i = 0; i < turned; ++i) start.emplace_back(0.0, 0.0, spread(i, turned, options.reach_rad));
  return start;
}

Flight fly(std::span<const Eigen::Vector3d> start, std::int32_t valid, const Fit& fit,
           const SwarmOptions& options, const FlightKey& key, const std::function<bool()>& done) {
  Flight flight = initialize(start, fit);                     // step 1
  const double enough = (1.0 - options.good_enough) * valid;  // f < epsilon
  while (flight.iterations < options.iterations && flight.fit <= enough && !(done && done())) {  // step 4
    const auto k = static_cast<std::uint32_t>(flight.iterations);
    for (std::size_t i = 0; i < flight.particles.size(); ++i) {  // step 2
      CounterRng rng(key.seed, key.scan, key.flight * 0x10000U + k, static_cast<std::uint32_t>(i));
      const Eigen::Vector3d r1 = draw(rng);
      const Eigen::Vector3d r2 = draw(rng);
      move(flight.particles[i], flight.best, options, r1, r2);
    }
    evaluate(flight, fit);  // step 3
    remember_swarm_best(flight);
    ++flight.iterations;
  }
  return flight;
}

}  // namespace landfall::internal
