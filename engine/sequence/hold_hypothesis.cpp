#include "engine/sequence/hold_hypothesis.hpp"

#include <vector>

#include "engine/refine/settle.hpp"
#include "engine/verify/verify.hpp"

namespace landfall::internal {
namespace {

// A single scan is a composite of one.
Scan in_parts(const Scan& scan) {
  Scan composite = scan;
  if (!composite.parts)
    composite.parts = {
        .beams = {scan.ranges_m.size()}, .T_reference_robot = {Pose2{}}, .reference = 0, .noise = {}};
  return composite;
}

std::vector<Pose2> held_parts(const PreparedState& map, const Scan& composite, const Pose2& T_map_expected,
                              const OdometrySigma& sigma) {
  SettleProblem problem(map, composite);
  problem.expect_reference(T_map_expected, sigma.translation_m, sigma.rotation_rad);
  std::vector<std::vector<Pose2>> T_map_starts(1);
  for (const Pose2& T_reference_robot : problem.T_reference_robot())
    T_map_starts.front().push_back(T_map_expected * T_reference_robot);
  return settle(problem, T_map_starts);
}

}  // namespace

std::optional<Hypothesis> hold_hypothesis(const PreparedMap& map, const Scan& scan,
                                          const Pose2& T_map_expected, const OdometrySigma& sigma,
                                          const SearchOptions& options) {
  const Scan composite = in_parts(scan);
  const std::vector<Pose2> T_map_part = held_parts(map.state(), composite, T_map_expected, sigma);
  const Pose2& T_map_robot = T_map_part[composite.parts->reference];
  const GridMap& grid = map.grid();
  if (!grid.contains(grid.cell_of({.x_m = T_map_robot.x_m, .y_m = T_map_robot.y_m}))) return std::nullopt;
  const SearchResult there = search(map, PosePrior{CandidatePoses{{T_map_robot}}}, scan, options);
  if (there.hypotheses.empty()) return std::nullopt;
  Hypothesis held = there.hypotheses.front();
  held.T_map_robot = T_map_robot;
  held.explained =
      verify(map.state(), remount(composite, T_map_part), std::span(&T_map_robot, 1)).front().explained;
  return held;
}

}  // namespace landfall::internal
