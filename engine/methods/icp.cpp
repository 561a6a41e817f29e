// Scan matchers as search methods from a close prior: iterative closest point (Besl & McKay 1992; point to
// line: Chen & Medioni 1992) against the centres of the map's occupied cells, and cross-correlated histograms
// (Weiss et al. 1994) against the scan that the map would give at the prior's middle. The map may be one that
// was made from a single earlier scan. A prior larger than their reach is answered from starts all over it.
#include <cmath>
#include <optional>
#include <vector>

#include "engine/base/parallel.hpp"
#include "engine/maps/to_raycast.hpp"
#include "engine/methods/free_search.hpp"
#include "engine/methods/table.hpp"
#include "engine/scan_matching/angle_histogram.hpp"
#include "engine/scan_matching/icp.hpp"

namespace landfall::internal {
namespace {

constexpr CenterReach icp_reach{.translation_m = 0.5, .rotation_rad = 0.35};
constexpr CenterReach histogram_reach{.translation_m = 0.5, .rotation_rad = 0.87};
constexpr double starts_per_reach = 2.0;

std::vector<Point2> end_points_robot(const Query& query) {
  std::vector<Point2> points;
  for (std::size_t i = 0; i < query.points.x_cells_by_beam.size(); ++i)
    points.push_back({.x_m = query.points.x_cells_by_beam[i] * query.lattice.resolution_m,
                      .y_m = query.points.y_cells_by_beam[i] * query.lattice.resolution_m});
  return points;
}

// Matched from every start; the own score is that of pso.
template <class Matched>
Proposal propose_matched(const Query& query, const CenterReach& reach, const Matched& match) {
  const MapFit fit(query);
  const std::vector<Pose2> starts = search_centers(query, reach, starts_per_reach);
  std::vector<std::optional<FreeCandidate>> matched(starts.size());
  (void)query.map.field();
  parallel_for(starts.size(), query.threads, [&](std::size_t i) {
    if (query.out_of_time()) return;
    const Pose2 T_map_robot = match(starts[i]);
    matched[i] = {.T_map_robot = T_map_robot, .score = fit.at(T_map_robot)};
  });
  std::vector<FreeCandidate> found;
  for (const std::optional<FreeCandidate>& one : matched)
    if (one) found.push_back(*one);
  const auto count = static_cast<std::int64_t>(found.size());
  Proposal proposal = propose_free(query, std::move(found));
  proposal.counts.poses_scored = count;
  return proposal;
}

Proposal propose_icp(const Query& query, bool to_line) {
  const std::vector<Point2> moving = end_points_robot(query);
  const IcpTarget& target = query.map.icp_target();
  const IcpOptions options{.to_line = to_line, .reach_m = icp_reach.translation_m};
  return propose_matched(
      query, icp_reach, [&](const Pose2& T_map_start) { return target.match(moving, T_map_start, options); });
}

// What the scan's sensor would see of the map, in the robot's frame, in the order of its beams.
std::vector<Point2> seen_from(const Query& query, const Pose2& T_map_robot) {
  const std::vector<raycast::Beam> beams = to_raycast(*query.scan.sensor);
  const raycast::Pose pose = to_raycast(T_map_robot);
  std::vector<float> ranges_m(beams.size());
  query.map.scene().cast_fans(std::span(&pose, 1), beams, ranges_m);
  std::vector<Point2> points;
  for (std::size_t b = 0; b < beams.size(); ++b) {
    const Beam& beam = query.scan.sensor->beams[b];
    if (classify(beam, ranges_m[b]) == Reading::echo)
      points.push_back(beam.T_robot_beam * Point2{.x_m = ranges_m[b], .y_m = 0.0});
  }
  return points;
}

}  // namespace

Proposal propose_icp(const Query& query) {
  return propose_icp(query, false);
}
Proposal propose_icp_point_to_line(const Query& query) {
  return propose_icp(query, true);
}
Proposal propose_angle_histogram(const Query& query) {
  const std::vector<Point2> after = end_points_robot(query);
  const HistogramOptions options{.reach_m = histogram_reach.translation_m,
                                 .reach_rad = histogram_reach.rotation_rad};
  Proposal proposal = propose_matched(query, histogram_reach, [&](const Pose2& T_map_start) {
    return T_map_start * match_histograms(seen_from(query, T_map_start), after, {}, options);
  });
  proposal.counts.rays_cast =
      proposal.counts.poses_scored * static_cast<std::int64_t>(query.scan.sensor->beams.size());
  return proposal;
}

}  // namespace landfall::internal
