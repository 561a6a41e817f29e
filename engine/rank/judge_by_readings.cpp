#include "engine/rank/judge_by_readings.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

#include "engine/base/parallel.hpp"
#include "engine/evidence.hpp"
#include "engine/rank/cone_model.hpp"
#include "engine/refine/field_normal.hpp"

namespace landfall::internal {
namespace {

constexpr double most_gained_nats = 12.0;  // by the search around a pose
constexpr double reach_steps = 4.0;        // of the lattice

// A pose with what speaks for it.
struct Judged {
  Pose2 T_map_robot;
  std::int64_t poses = 1;  // looked at
  double share = 0.0;
  double log_readings = 0.0;
  double log_likelihood = -std::numeric_limits<double>::infinity();  // of end points and readings
};

class Judge {
 public:
  explicit Judge(const Query& query) : query_(query), cones_(query.map, *query.scan.measured) {}

  [[nodiscard]] Judged at(const Pose2& T_map_robot) const {
    const double log_readings = cones_.log_likelihood(T_map_robot);
    const double share = share_at(T_map_robot);
    return {.T_map_robot = T_map_robot,
            .share = share,
            .log_readings = log_readings,
            .log_likelihood = log_evidence(share, query_.points.size()) + log_readings};
  }

  // By half a step of the lattice at first, by a sixteenth at last.
  [[nodiscard]] Judged best_around(const Judged& start) const {
    constexpr double first_steps = 0.5;
    constexpr double last_steps = 0.0625;
    constexpr int most_moves = 50;
    Judged best = start;
    std::int64_t poses = 1;
    int moves = 0;
    for (double steps = first_steps; steps >= last_steps && moves < most_moves;) {
      const Judged next = best_beside(best, steps, start.T_map_robot);
      poses += next.poses;
      if (next.log_likelihood > best.log_likelihood) {
        best = next;
        ++moves;
      } else {
        steps *= 0.5;
      }
    }
    best.poses = poses;
    return best;
  }

 private:
  // Of the end points, each 0..1.
  [[nodiscard]] double share_at(const Pose2& T_map_robot) const {
    const Lattice& lattice = query_.lattice;
    const Pose2 T_grid_robot = inverse(lattice.T_map_grid) * T_map_robot;
    const Eigen::Vector3d pose(T_grid_robot.x_m / lattice.resolution_m,
                               T_grid_robot.y_m / lattice.resolution_m, T_grid_robot.theta_rad);
    return linearise(query_.map, query_.points, pose, Residual::lack).field /
           static_cast<double>(std::max<std::size_t>(1, query_.points.size()));
  }

  // Of eight neighbours, and a turn to either side, that lie near where the search began.
  [[nodiscard]] Judged best_beside(const Judged& center, double steps, const Pose2& T_map_start) const {
    constexpr std::array<std::array<int, 3>, 10> directions{{{1, 0, 0},
                                                             {-1, 0, 0},
                                                             {0, 1, 0},
                                                             {0, -1, 0},
                                                             {0, 0, 1},
                                                             {0, 0, -1},
                                                             {1, 1, 0},
                                                             {1, -1, 0},
                                                             {-1, 1, 0},
                                                             {-1, -1, 0}}};
    const double lattice_step_m = query_.lattice.step_cells * query_.lattice.resolution_m;
    const double lattice_step_rad = query_.lattice.heading_step_rad();
    Judged best;
    std::int64_t poses = 0;
    for (const auto& [x, y, turn] : directions) {
      const Pose2 T_map_robot{center.T_map_robot.x_m + x * steps * lattice_step_m,
                              center.T_map_robot.y_m + y * steps * lattice_step_m,
                              wrap_angle(center.T_map_robot.theta_rad + turn * steps * lattice_step_rad)};
      if (translation_distance(T_map_robot, T_map_start) > reach_steps * lattice_step_m ||
          angle_distance(T_map_robot.theta_rad, T_map_start.theta_rad) > reach_steps * lattice_step_rad)
        continue;
      const Judged there = at(T_map_robot);
      ++poses;
      if (there.log_likelihood > best.log_likelihood) best = there;
    }
    best.poses = poses;
    return best;
  }

  const Query& query_;
  ConeModel cones_;
};

}  // namespace

void judge_by_readings(const Query& query, Modes& found, SearchCounts& counts) {
  if (!query.scan.measured || found.by_ranges || found.modes.empty()) return;
  const Judge judge(query);
  std::vector<Judged> judged(found.modes.size());
  parallel_for(judged.size(), query.threads,
               [&](std::size_t i) { judged[i] = judge.at(found.modes[i].hypothesis.T_map_robot); });
  const auto weight = [&](std::size_t i) { return found.modes[i].log_prior + judged[i].log_likelihood; };
  double most = weight(0);
  for (std::size_t i = 1; i < judged.size(); ++i) most = std::max(most, weight(i));
  parallel_for(judged.size(), query.threads, [&](std::size_t i) {
    if (weight(i) >= most - most_gained_nats && !query.out_of_time())
      judged[i] = judge.best_around(judged[i]);
    Mode& mode = found.modes[i];
    mode.hypothesis.T_map_robot = judged[i].T_map_robot;
    mode.share = judged[i].share;
    mode.log_readings = judged[i].log_readings;
  });
  for (const Judged& one : judged)
    counts.rays_cast += one.poses * static_cast<std::int64_t>(count_valid(*query.scan.measured));
  std::vector<std::size_t> order(judged.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return weight(a) > weight(b); });
  std::vector<Mode> sorted;
  sorted.reserve(order.size());
  for (const std::size_t i : order) sorted.push_back(std::move(found.modes[i]));
  found.modes = std::move(sorted);
  drop_repeated(query.options, found.modes);
}

}  // namespace landfall::internal
