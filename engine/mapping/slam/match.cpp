#include "engine/mapping/slam/match.hpp"

#include <algorithm>
#include <cmath>

#include "engine/align/residual_sum.hpp"
#include "engine/base/rigid.hpp"
#include "engine/methods/pso/swarm.hpp"
#include "kernels/count_fits.hpp"

namespace landfall::internal {
namespace {

// Of all surface points, so many must meet something known for a match to say anything.
constexpr double least_overlap = 0.25;
// The predicted pose is preferred unless the swarm's fits better than by this share.
constexpr double clearly_better = 0.01;
constexpr double on_surface_m = 0.1;
constexpr double far_m = 1.0;

// Data_fit: end points in occupied cells.
class FitCounter {
 public:
  FitCounter(const EvidenceGrid& grid, const PreparedScan& scan)
      : scan_(scan), bits_(grid.occupied()), first_(grid.first()), cell_m_(grid.resolution_m()) {}

  [[nodiscard]] std::int32_t at(const Pose2& T_map_robot) const {
    return kernels::count_fits(bits_,
                               {.x_cells = static_cast<float>(T_map_robot.x_m / cell_m_ - first_.col),
                                .y_cells = static_cast<float>(T_map_robot.y_m / cell_m_ - first_.row),
                                .cos_theta = static_cast<float>(std::cos(T_map_robot.theta_rad)),
                                .sin_theta = static_cast<float>(std::sin(T_map_robot.theta_rad))},
                               scan_.x_cells.data(), scan_.y_cells.data(), scan_.x_cells.size());
  }

 private:
  const PreparedScan& scan_;
  kernels::CellBits bits_;
  CellIndex first_;
  double cell_m_;
};

Match refined(const MapSoFar& map, const PreparedScan& scan, const Pose2& T_map_start) {
  return judge(map, scan, map.surfaces.refine(scan.surfaces, T_map_start));
}

}  // namespace

Match judge(const MapSoFar& map, const PreparedScan& scan, const Pose2& T_map_robot) {
  Match match{.T_map_robot = T_map_robot};
  const Rigid to_map(T_map_robot);
  int in_free_space = 0;
  int points = 0;
  double misfit = 0.0;
  for (const SurfacePoint& point : scan.surfaces) {
    if (!point.has_normal) continue;
    const Point2 p_map = to_map.point(point.p);
    ++points;
    const double off_m = map.surfaces.distance(p_map, to_map.direction(point.normal)).value_or(far_m);
    const double squared = off_m * off_m;
    misfit += squared / (squared + ResidualSum::outlier_m * ResidualSum::outlier_m);
    if (off_m <= on_surface_m)
      ++match.on_surfaces;
    else if (map.grid.at(map.grid.cell_of(p_map)) == Occupancy::free)
      ++in_free_space;
  }
  match.misfit = misfit / std::max(1, points);
  const int known = match.on_surfaces + in_free_space;
  match.agreement = known == 0 ? 0.0 : static_cast<double>(match.on_surfaces) / known;
  match.fit = FitCounter(map.grid, scan).at(T_map_robot) / std::max(1.0, static_cast<double>(scan.valid()));
  return match;
}

bool is_acceptable(const Match& match, const PreparedScan& scan, const SlamOptions& options) {
  const auto points = std::count_if(scan.surfaces.begin(), scan.surfaces.end(),
                                    [](const SurfacePoint& point) { return point.has_normal; });
  return match.on_surfaces > 0 && match.agreement >= options.least_agreement &&
         match.on_surfaces >= least_overlap * static_cast<double>(points);
}

Match match_by_swarm(const MapSoFar& map, const PreparedScan& scan, const Pose2& T_map_predicted,
                     const SlamOptions& options, std::uint32_t scan_number) {
  const FitCounter counter(map.grid, scan);
  const auto pose_of = [&](const Eigen::Vector3d& z) {
    return T_map_predicted * Pose2{.x_m = z[0], .y_m = z[1], .theta_rad = z[2]};
  };
  const Flight flight = fly(start_pattern(options.swarm), scan.valid(),
                            [&](const Eigen::Vector3d& z) { return counter.at(pose_of(z)); }, options.swarm,
                            {.seed = options.seed, .scan = scan_number});
  const Pose2 T_map_best = pose_of(flight.best);
  if (!options.refine) return judge(map, scan, T_map_best);
  const Match by_swarm = refined(map, scan, T_map_best);
  const Match by_prediction = refined(map, scan, T_map_predicted);
  return by_swarm.misfit < (1.0 - clearly_better) * by_prediction.misfit ? by_swarm : by_prediction;
}

}  // namespace landfall::internal
