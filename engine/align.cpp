#include "landfall/align.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "engine/evidence.hpp"
#include "engine/methods/table.hpp"
#include "engine/odometry.hpp"
#include "engine/refine.hpp"
#include "landfall/error.hpp"
#include "landfall/mapping.hpp"

namespace landfall {
namespace {

using namespace internal;

constexpr double farthest_m = 20.0;  // end points beyond are sparse and say little of a step
// An end point in a part that no scan has seen yet is worth this, of 255; one in seen free space nothing.
constexpr std::uint8_t unknown_value = 40;
constexpr double field_sigma_m = 0.08;

// Neighbouring echoes this close lie on one surface.
double most_gap_m(float range_m) {
  return 0.15 + 0.05 * range_m;
}

// A scan's surfaces: its end points, and the lines between neighbouring ones.
void draw_surfaces(const Scan& scan, GridMap& map) {
  std::optional<Point2> last;
  for (std::size_t b = 0; b < scan.ranges_m.size(); ++b) {
    const Beam& beam = scan.sensor->beams[b];
    if (classify(beam, scan.ranges_m[b]) != Reading::echo || scan.ranges_m[b] > farthest_m) {
      last.reset();
      continue;
    }
    const Point2 p = *scan.T_map_robot * (beam.T_robot_beam * Point2{scan.ranges_m[b], 0.0});
    const double gap_m = last ? std::hypot(p.x_m - last->x_m, p.y_m - last->y_m) : 0.0;
    const int steps = gap_m <= most_gap_m(scan.ranges_m[b]) ? static_cast<int>(gap_m / map.resolution_m) : 0;
    for (int i = 0; i <= steps; ++i) {
      const double along = steps == 0 ? 0.0 : static_cast<double>(i) / (steps + 1);
      const Point2 at =
          last ? Point2{p.x_m + along * (last->x_m - p.x_m), p.y_m + along * (last->y_m - p.y_m)} : p;
      const CellIndex cell = map.cell_of(at);
      if (map.contains(cell)) map.cells[map.index(cell)] = Occupancy::occupied;
    }
    last = p;
  }
}

// The composite so far as a map: what its scans saw as walls and as free, the rest unknown.
// `margin_m` around them.
GridMap composite_map(std::span<const Scan> placed, double margin_m, const AlignOptions& options) {
  GridMap map = map_from_known_poses(
      placed, {.resolution_m = options.resolution_m, .range_max_m = farthest_m, .margin_m = margin_m});
  for (const Scan& scan : placed) draw_surfaces(scan, map);
  return map;
}

// A robot may have been anywhere in it.
std::shared_ptr<const BlockMask> every_cell(const GridMap& map) {
  BlockMask all = make_block_mask(0, 0, map.width_cells - 1, map.height_cells - 1);
  for (int row = 0; row < map.height_cells; ++row)
    for (int col = 0; col < map.width_cells; ++col) all.insert(col, row);
  return std::make_shared<const BlockMask>(std::move(all));
}

// The pose of most posterior evidence: the scan's match to the composite, and odometry.
Pose2 match(const Scan& scan, std::span<const Scan> placed, const Pose2& T_reference_guess,
            const OdometrySigma& sigma, const AlignOptions& options) {
  // The last scan placed is the neighbour: the robot may stand this far outside of what that saw.
  const double margin_m =
      translation_distance(T_reference_guess, *placed.back().T_map_robot) + 3.0 * sigma.translation_m;
  const PreparedState map(composite_map(placed, margin_m, options), std::nullopt,
                          {.field_sigma_m = field_sigma_m, .unknown_value = unknown_value, .name = {}});
  const EndPoints points = make_end_points(scan, options.resolution_m);
  if (points.size() == 0) return T_reference_guess;
  const SearchOptions search_options;
  const Lattice lattice = make_lattice(map.grid(), 0.0, search_options.rotation_step_rad);
  const Gaussian prior{.T_map_robot = T_reference_guess,
                       .covariance = {sigma.translation_m * sigma.translation_m, 0, 0, 0,
                                      sigma.translation_m * sigma.translation_m, 0, 0, 0,
                                      sigma.rotation_rad * sigma.rotation_rad}};
  const Domain domain = make_domain({prior}, lattice, every_cell(map.grid()));
  const Query query{.map = map,
                    .scan = scan,
                    .points = points,
                    .lattice = lattice,
                    .domain = domain,
                    .options = search_options,
                    .margin = rival_margin(points.size()),
                    .threads = options.threads,
                    .deadline = {}};
  const Proposal proposal = propose_branch_and_bound(query);
  const double nats = evidence_nats(points.size());
  double best = -1e300;
  Pose2 T_reference_best = T_reference_guess;
  for (const Candidate& candidate : proposal.candidates) {
    const double evidence =
        nats * share_of(candidate.score, points.size()) + domain.log_prior(lattice, candidate.pose);
    if (evidence <= best) continue;
    best = evidence;
    T_reference_best = lattice.T_map_robot(candidate.pose);
  }
  return refine(map, points, lattice, T_reference_best).T_map_robot;
}

}  // namespace

std::vector<Pose2> align(std::span<const Scan> scans, std::size_t reference, const AlignOptions& options) {
  if (scans.empty()) throw Error(ErrorCode::invalid_argument, "align: no scans");
  if (reference >= scans.size())
    throw Error(ErrorCode::invalid_argument, "align: reference is " + std::to_string(reference) +
                                                 ", expected less than " + std::to_string(scans.size()));
  if (!(options.resolution_m > 0.0) || !std::isfinite(options.resolution_m))
    throw Error(
        ErrorCode::invalid_argument,
        "align: resolution_m is " + std::to_string(options.resolution_m) + ", expected a positive number");
  for (std::size_t i = 0; i < scans.size(); ++i) {
    validate(scans[i]);
    if (!scans[i].T_odom_robot)
      throw Error(ErrorCode::invalid_argument, "align: scan " + std::to_string(i) + " has no odometry");
  }
  std::vector<Pose2> T_reference_robot(scans.size());
  std::vector<Scan> placed{scans[reference]};
  placed.back().T_map_robot = Pose2{};
  const bool seen = count_echoes(scans[reference]) > 0;
  const auto place = [&](std::size_t i, std::size_t neighbour) {
    const Pose2 T_neighbour_robot = inverse(*scans[neighbour].T_odom_robot) * *scans[i].T_odom_robot;
    const Pose2 T_reference_guess = T_reference_robot[neighbour] * T_neighbour_robot;
    const OdometrySigma sigma = odometry_sigma(options.odometry, T_neighbour_robot);
    T_reference_robot[i] =
        seen ? match(scans[i], placed, T_reference_guess, sigma, options) : T_reference_guess;
    placed.push_back(scans[i]);
    placed.back().T_map_robot = T_reference_robot[i];
  };
  for (std::size_t i = reference; i-- > 0;) place(i, i + 1);
  for (std::size_t i = reference + 1; i < scans.size(); ++i) place(i, i - 1);
  return T_reference_robot;
}

}  // namespace landfall
