// A stochastic diffusion network: the plain one over a single level, the focused one over a pyramid.
//
// Beattie & Bishop, sections 2 and 3. Ours: an iteration's diffusion is done together with the next one's
// testing, in one pass over the cells, of which each sees the others as they were before.
#pragma once

#include <cstdint>
#include <span>

#include "engine/methods/sdn/cells.hpp"
#include "engine/methods/sdn/test_rays.hpp"
#include "engine/priors/pose_sampler.hpp"

namespace landfall::internal {

// What a network searches, shared by all that search it.
struct SearchSpace {
  std::span<const FocusLevel> levels;
  const PoseSampler& sampler;
  std::span<const std::size_t> start_levels;  // per component of the sampler
  const BeamBands& bands;
  const TestRays& rays;
};

// Poses of modes found before: no cell passes a test there.
struct Excluded {
  std::span<const Pose2> T_map_mode{};
  FocusLevel reach{};

  [[nodiscard]] bool contains(const Pose2& T_map_robot) const;
};

struct NetworkCounts {
  std::int64_t draws = 0;    // of new mappings
  std::int64_t copies = 0;   // of another cell's
  std::int64_t tests = 0;    // rays cast
  std::int64_t active = 0;   // cells, in the last iteration
  std::int64_t focused = 0;  // cells within tolerance at the finest level, in the last iteration
  double cast_ms = 0.0;      // processor time in ray casting, where it was to be measured,
  double step_ms = 0.0;      // and in all of the iterations, the search for clusters included

  void add(const NetworkCounts& other);
};

struct NetworkOptions {
  std::size_t cells = 0;
  std::uint64_t seed = 0;
  std::uint32_t run = 0;  // counts the networks of one scan
  int threads = 1;
  bool measure_time = false;
};

class Network {
 public:
  Network(const SearchSpace& space, const Excluded& excluded, const NetworkOptions& options);

  // One iteration: diffusion (at first initialisation), then testing.
  void step();

  [[nodiscard]] const Cells& cells() const { return cells_; }
  [[nodiscard]] std::uint32_t iterations() const { return iteration_; }
  // Of all iterations; active and focused of the last one.
  [[nodiscard]] const NetworkCounts& counts() const { return counts_; }

 private:
  NetworkCounts step_chunk(std::size_t first, std::size_t count);
  // Another cell, chosen at random.
  [[nodiscard]] const Mapping& poll(std::size_t cell, CounterRng& rng) const;
  void diffuse(std::size_t cell, CounterRng& rng, NetworkCounts& counts);

  SearchSpace space_;
  Excluded excluded_;
  NetworkOptions options_;
  Cells cells_;
  std::uint32_t iteration_ = 0;
  NetworkCounts counts_;
};

}  // namespace landfall::internal
