#include "engine/methods/free_search.hpp"

#include <algorithm>
#include <cmath>

#include "engine/lattice_score.hpp"
#include "engine/priors/pose_sampler.hpp"

namespace landfall::internal {
namespace {

constexpr int draws_for_middle = 512;
constexpr std::uint32_t middle_stream = 0xfffffff0U;
constexpr std::uint32_t center_stream = 0xfffffff1U;

// Of a prior's poses, headings around the circle.
Pose2 middle_of(const PoseSampler& sampler, std::uint64_t seed) {
  CounterRng rng(seed, middle_stream);
  Pose2 sum;
  double cos_sum = 0.0;
  double sin_sum = 0.0;
  for (int i = 0; i < draws_for_middle; ++i) {
    const Pose2 pose = sampler.draw(rng);
    sum.x_m += pose.x_m;
    sum.y_m += pose.y_m;
    cos_sum += std::cos(pose.theta_rad);
    sin_sum += std::sin(pose.theta_rad);
  }
  return {.x_m = sum.x_m / draws_for_middle,
          .y_m = sum.y_m / draws_for_middle,
          .theta_rad = std::atan2(sin_sum, cos_sum)};
}

}  // namespace

std::vector<Pose2> search_centers(const Query& query, const CenterReach& reach, double density) {
  const PoseSampler sampler(query.lattice, query.domain);
  const double slack = 1.01;
  if (sampler.half_extent_m() <= slack * reach.translation_m + query.lattice.resolution_m &&
      sampler.half_extent_rad() <= slack * reach.rotation_rad + query.lattice.heading_step_rad())
    return {middle_of(sampler, query.options.seed)};
  const double part = 8.0 * reach.translation_m * reach.translation_m * reach.rotation_rad;
  const double wanted = std::ceil(density * sampler.volume() / part);
  const auto count = static_cast<std::size_t>(std::clamp(wanted, 1.0, static_cast<double>(most_centers)));
  std::vector<Pose2> centers;
  for (std::size_t i = 0; i < count; ++i) {
    CounterRng rng(query.options.seed, center_stream, static_cast<std::uint32_t>(i));
    centers.push_back(sampler.draw(rng));
  }
  return centers;
}

MapFit::MapFit(const Query& query)
    : grid_(query.map.grid()),
      T_grid_map_(inverse(grid_.T_map_grid)),
      bits_(query.map.occupied_bits()),
      x_cells_(query.points.x_cells.begin(), query.points.x_cells.end()),
      y_cells_(query.points.y_cells.begin(), query.points.y_cells.end()) {}

std::int32_t MapFit::at(const Pose2& T_map_robot) const {
  const Pose2 T_grid_robot = T_grid_map_ * T_map_robot;
  return kernels::count_fits(
      bits_.view(),
      {.x_cells = static_cast<float>(T_grid_robot.x_m / grid_.resolution_m + OccupiedBits::border),
       .y_cells = static_cast<float>(T_grid_robot.y_m / grid_.resolution_m + OccupiedBits::border),
       .cos_theta = static_cast<float>(std::cos(T_grid_robot.theta_rad)),
       .sin_theta = static_cast<float>(std::sin(T_grid_robot.theta_rad))},
      x_cells_.data(), y_cells_.data(), x_cells_.size());
}

Proposal propose_free(const Query& query, std::vector<FreeCandidate> found, std::size_t most) {
  std::stable_sort(found.begin(), found.end(),
                   [](const FreeCandidate& a, const FreeCandidate& b) { return a.score > b.score; });
  if (found.size() > most) found.resize(most);
  struct Pair {
    Candidate candidate;
    FreeCandidate free;
  };
  std::vector<Pair> pairs;
  for (const FreeCandidate& one : found)
    if (const auto candidate = best_on_lattice_beside(query, one.T_map_robot))
      pairs.push_back({*candidate, one});
  std::stable_sort(pairs.begin(), pairs.end(),
                   [](const Pair& a, const Pair& b) { return better(a.candidate, b.candidate); });
  Proposal proposal;
  for (const Pair& pair : pairs) {
    proposal.candidates.push_back(pair.candidate);
    proposal.free_candidates.push_back(pair.free);
  }
  return proposal;
}

}  // namespace landfall::internal
