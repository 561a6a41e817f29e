#include "engine/verify.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/to_raycast.hpp"

namespace landfall::internal {
namespace {

constexpr double neighbour_rad = 0.03;  // beams closer than this see the same edge

struct ValidBeam {
  std::size_t beam;
  float range_m;
  bool echo;
  float tolerance_m;
  bool next_is_neighbour;  // the beam after it, in the list of valid beams
};

std::vector<ValidBeam> valid_beams(const Scan& scan, double resolution_m) {
  const Sensor& sensor = *scan.sensor;
  std::vector<ValidBeam> beams;
  for (std::size_t b = 0; b < scan.ranges_m.size(); ++b) {
    const Reading reading = classify(sensor.beams[b], scan.ranges_m[b]);
    if (reading == Reading::invalid) continue;
    const double seen_m = std::min<double>(scan.ranges_m[b], sensor.beams[b].range_max_m);
    const double noise_m = sensor.range_noise_m + sensor.range_noise_relative * seen_m;
    if (!beams.empty()) {
      const Beam& last = sensor.beams[beams.back().beam];
      beams.back().next_is_neighbour =
          angle_distance(last.T_robot_beam.theta_rad, sensor.beams[b].T_robot_beam.theta_rad) <
              neighbour_rad &&
          translation_distance(last.T_robot_beam, sensor.beams[b].T_robot_beam) < resolution_m;
    }
    beams.push_back({.beam = b,
                     .range_m = scan.ranges_m[b],
                     .echo = reading == Reading::echo,
                     .tolerance_m = static_cast<float>(3.0 * noise_m + 2.0 * resolution_m),
                     .next_is_neighbour = false});
  }
  return beams;
}

// How far the measured range is from what the map has around the beam; +inf: echo against no echo.
float mismatch_m(const ValidBeam& beam, float before_m, float here_m, float after_m) {
  constexpr float none = std::numeric_limits<float>::infinity();
  const auto distance = [&](float simulated_m) {
    if (!beam.echo) return std::isinf(simulated_m) ? 0.0F : none;
    return std::isinf(simulated_m) ? none : std::abs(simulated_m - beam.range_m);
  };
  return std::min({distance(before_m), distance(here_m), distance(after_m)});
}

}  // namespace

std::vector<double> explained_shares(const PreparedState& map, const Scan& scan,
                                     std::span<const Pose2> T_map_robot) {
  const std::vector<ValidBeam> valid = valid_beams(scan, map.grid().resolution_m);
  std::vector<double> answers(T_map_robot.size());
  if (valid.empty() || T_map_robot.empty()) return answers;
  const std::vector<raycast::Beam> all = to_raycast(*scan.sensor);
  std::vector<raycast::Beam> beams;
  for (const ValidBeam& beam : valid) beams.push_back(all[beam.beam]);
  std::vector<raycast::Pose> poses;
  for (const Pose2& pose : T_map_robot) poses.push_back(to_raycast(pose));
  std::vector<float> simulated_m(poses.size() * beams.size());
  map.scene().cast_fans(poses, beams, simulated_m);
  for (std::size_t p = 0; p < poses.size(); ++p) {
    const float* ranges_m = simulated_m.data() + p * beams.size();
    for (std::size_t i = 0; i < valid.size(); ++i) {
      const float before_m = i > 0 && valid[i - 1].next_is_neighbour ? ranges_m[i - 1] : ranges_m[i];
      const float after_m = valid[i].next_is_neighbour ? ranges_m[i + 1] : ranges_m[i];
      const float off_m = mismatch_m(valid[i], before_m, ranges_m[i], after_m);
      if (off_m <= valid[i].tolerance_m) answers[p] += 1.0;
    }
    answers[p] /= static_cast<double>(valid.size());
  }
  return answers;
}

}  // namespace landfall::internal
