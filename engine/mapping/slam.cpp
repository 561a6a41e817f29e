#include "landfall/slam.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "engine/base/options.hpp"
#include "engine/base/rigid.hpp"
#include "engine/mapping/slam/check.hpp"
#include "engine/mapping/slam/match.hpp"
#include "landfall/error.hpp"

namespace landfall {
namespace internal {
namespace {

using Clock = std::chrono::steady_clock;

double ms_since(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

Pose2 scaled(const Pose2& motion, double factor) {
  return {.x_m = factor * motion.x_m, .y_m = factor * motion.y_m, .theta_rad = factor * motion.theta_rad};
}

}  // namespace

class SlamState {
 public:
  explicit SlamState(const SlamOptions& options)
      : options_(options), map_{.grid = EvidenceGrid(options), .surfaces = {}, .path = {}} {}

  SlamStep add(const Scan& scan) {
    const PreparedScan prepared = prepare(scan, options_);
    const auto number = scan_number_++;
    SlamStep step;
    step.T_map_robot = predict(scan);
    if (prepared.valid() == 0) return step;
    if (map_.path.empty()) {
      step.accepted = true;
      step.agreement = step.fit = 1.0;
    } else {
      match(scan, prepared, number, step);
    }
    if (step.accepted) insert(scan, prepared, step);
    misses_ = step.accepted ? 0 : misses_ + 1;
    return step;
  }

  [[nodiscard]] GridMap map() const { return map_.grid.to_map(); }
  [[nodiscard]] std::size_t memory_bytes() const {
    return map_.grid.memory_bytes() + map_.surfaces.memory_bytes();
  }

 private:
  struct Stand {
    Pose2 T_map_robot;
    double stamp_s = 0.0;
    std::optional<Pose2> T_odom_robot;
  };

  [[nodiscard]] Pose2 predict(const Scan& scan) const {
    if (!last_) return {};
    if (options_.prediction == SlamPrediction::odometry && last_->T_odom_robot && scan.T_odom_robot)
      return last_->T_map_robot * (inverse(*last_->T_odom_robot) * *scan.T_odom_robot);
    if (options_.prediction == SlamPrediction::constant_velocity && before_) {
      constexpr double longest = 3.0;  // steps that velocity is trusted for
      const double period_s = last_->stamp_s - before_->stamp_s;
      const double steps = period_s > 0.0 ? (scan.stamp_s - last_->stamp_s) / period_s : 1.0;
      return last_->T_map_robot *
             scaled(inverse(before_->T_map_robot) * last_->T_map_robot, std::clamp(steps, 0.0, longest));
    }
    return last_->T_map_robot;
  }

  void match(const Scan& scan, const PreparedScan& prepared, std::uint32_t number, SlamStep& step) {
    const Pose2 T_map_predicted = step.T_map_robot;
    Clock::time_point start = Clock::now();
    if (options_.matcher == SlamMatcher::pso) {
      take(match_by_swarm(map_, prepared, T_map_predicted, options_, number), prepared, step);
    } else {
      take_best(match_in_window(map_, scan, prepared, T_map_predicted,
                                {options_.swarm.reach_m, options_.swarm.reach_rad}, options_),
                prepared, step);
    }
    step.match_ms = ms_since(start);
    if (step.accepted) return;
    start = Clock::now();
    recover(scan, prepared, T_map_predicted, step);
    step.recovery_ms = ms_since(start);
  }

  void recover(const Scan& scan, const PreparedScan& prepared, const Pose2& T_map_predicted, SlamStep& step) {
    constexpr int widest = 4;
    const double reach_m = options_.recovery_reach_m * (1 + std::min(widest, misses_));
    if (reach_m > 0.0)
      take_best(match_in_window(map_, scan, prepared, T_map_predicted, {reach_m, std::numbers::pi}, options_),
                prepared, step);
    step.recovered = step.accepted;
    if (!step.accepted) step.T_map_robot = T_map_predicted;
  }

  void take(const Match& match, const PreparedScan& prepared, SlamStep& step) const {
    step.T_map_robot = match.T_map_robot;
    step.fit = match.fit;
    step.agreement = match.agreement;
    step.accepted = is_acceptable(match, prepared, options_);
  }

  void take_best(const std::vector<Match>& matches, const PreparedScan& prepared, SlamStep& step) const {
    const auto best = std::max_element(matches.begin(), matches.end(), [](const Match& a, const Match& b) {
      return a.on_surfaces * a.agreement < b.on_surfaces * b.agreement;
    });
    if (best != matches.end()) take(*best, prepared, step);
  }

  void insert(const Scan& scan, const PreparedScan& prepared, SlamStep& step) {
    const Clock::time_point start = Clock::now();
    const Rigid to_map(step.T_map_robot);
    std::vector<EchoRay> rays = prepared.rays;
    for (EchoRay& ray : rays) {
      ray.from_map = to_map.point(ray.from_map);
      ray.to_map = to_map.point(ray.to_map);
    }
    const std::vector<Point2> gone =
        map_.grid.add_scan(rays, [this](const Point2& p_map, const EchoRay& ray) {
          return map_.surfaces.is_noise_of_a_wall(p_map, ray.to_map, ray.noise_m);
        });
    map_.surfaces.forget(gone);
    map_.surfaces.add_scan(prepared.surfaces, step.T_map_robot);
    map_.path.push_back(step.T_map_robot);
    step.cells_deleted = static_cast<int>(gone.size());
    before_ = std::exchange(last_, Stand{step.T_map_robot, scan.stamp_s, scan.T_odom_robot});
    step.insert_ms = ms_since(start);
  }

  SlamOptions options_;
  MapSoFar map_;
  std::optional<Stand> last_, before_;  // accepted scans
  std::uint32_t scan_number_ = 0;
  int misses_ = 0;  // scans in a row without match
};

}  // namespace internal

Slam::Slam(const SlamOptions& options) {
  internal::check(options);
  internal::validate_environment();
  state_ = std::make_unique<internal::SlamState>(options);
}
Slam::~Slam() = default;
Slam::Slam(Slam&&) noexcept = default;
Slam& Slam::operator=(Slam&&) noexcept = default;

SlamStep Slam::add(const Scan& scan) {
  validate(scan);
  return state_->add(scan);
}
GridMap Slam::map() const {
  return state_->map();
}
std::size_t Slam::memory_bytes() const {
  return state_->memory_bytes();
}

SlamResult slam(std::span<const Scan> scans, const SlamOptions& options) {
  if (scans.empty()) throw Error(ErrorCode::invalid_argument, "slam: no scans, expected at least one");
  Slam mapping(options);
  SlamResult result;
  for (const Scan& scan : scans) result.steps.push_back(mapping.add(scan));
  result.map = mapping.map();
  return result;
}

}  // namespace landfall
