#include "engine/verify/verify.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "engine/maps/to_raycast.hpp"
#include "engine/maps/wall_depth.hpp"
#include "engine/verify/contour.hpp"

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

bool are_neighbours(const Pose2& a, const Pose2& b, double resolution_m) {
  const double x_m = a.x_m - b.x_m;
  const double y_m = a.y_m - b.y_m;
  return angle_distance(a.theta_rad, b.theta_rad) < neighbour_rad &&
         x_m * x_m + y_m * y_m < resolution_m * resolution_m;  // hypot is slow
}

std::vector<ValidBeam> valid_beams(const Scan& scan, double resolution_m) {
  const Sensor& sensor = *scan.sensor;
  std::vector<ValidBeam> beams;
  beams.reserve(scan.ranges_m.size());
  for (std::size_t b = 0; b < scan.ranges_m.size(); ++b) {
    const Reading reading = classify(sensor.beams[b], scan.ranges_m[b]);
    if (reading == Reading::invalid) continue;
    const double seen_m = std::min<double>(scan.ranges_m[b], sensor.beams[b].range_max_m);
    const double noise_m = sensor.range_noise_m + sensor.range_noise_relative * seen_m;
    if (!beams.empty())
      beams.back().next_is_neighbour = are_neighbours(sensor.beams[beams.back().beam].T_robot_beam,
                                                      sensor.beams[b].T_robot_beam, resolution_m);
    beams.push_back({.beam = b,
                     .range_m = scan.ranges_m[b],
                     .echo = reading == Reading::echo,
                     .tolerance_m = static_cast<float>(3.0 * noise_m + 2.0 * resolution_m),
                     .next_is_neighbour = false});
  }
  return beams;
}

std::vector<ContourPiece> contour_of(const Scan& scan, const std::vector<ValidBeam>& valid) {
  std::vector<EchoRay> echoes;
  echoes.reserve(valid.size());
  for (const ValidBeam& beam : valid) {
    if (!beam.echo) continue;
    const Pose2& T_robot_beam = scan.sensor->beams[beam.beam].T_robot_beam;
    echoes.push_back({.origin_robot = {.x_m = T_robot_beam.x_m, .y_m = T_robot_beam.y_m},
                      .end_robot = T_robot_beam * Point2{.x_m = beam.range_m, .y_m = 0.0}});
  }
  return find_contour(echoes);
}

// Measured less simulated range, for whichever of the three simulated ones fits best; +-inf: an echo
// where the map has none, and the reverse.
float mismatch_m(const ValidBeam& beam, const std::array<float, 3>& simulated_m) {
  float least = std::numeric_limits<float>::infinity();
  for (const float range_m : simulated_m) {
    float off = 0.0F;
    if (beam.echo != !std::isinf(range_m))
      off = beam.echo ? -std::numeric_limits<float>::infinity() : std::numeric_limits<float>::infinity();
    else if (beam.echo)
      off = beam.range_m - range_m;
    if (std::abs(off) <= std::abs(least)) least = off;
  }
  return least;
}

// An echo behind the wall's face, but not behind the wall.
bool is_from_within_wall(const PreparedState& map, const Pose2& T_map_beam, const ValidBeam& beam,
                         float simulated_m) {
  if (!beam.echo || !(beam.range_m > simulated_m)) return false;
  return ends_within_wall(map.grid(), T_map_beam, simulated_m, beam.range_m - beam.tolerance_m);
}

Verification judge(const PreparedState& map, const Sensor& sensor, const Pose2& T_map_robot,
                   const std::vector<ValidBeam>& valid, std::span<const ContourPiece> contour,
                   std::span<const float> simulated_m) {
  constexpr float well_off_m = 0.5F;
  Verification sums;
  std::vector<bool> echo_explained;
  echo_explained.reserve(valid.size());
  for (std::size_t i = 0; i < valid.size(); ++i) {
    const float here_m = simulated_m[i];
    const float before_m = i > 0 && valid[i - 1].next_is_neighbour ? simulated_m[i - 1] : here_m;
    const float after_m = valid[i].next_is_neighbour ? simulated_m[i + 1] : here_m;
    const float off_m = mismatch_m(valid[i], {before_m, here_m, after_m});
    const bool explained =
        std::abs(off_m) <= valid[i].tolerance_m ||
        is_from_within_wall(map, T_map_robot * sensor.beams[valid[i].beam].T_robot_beam, valid[i], here_m);
    if (valid[i].echo) echo_explained.push_back(explained);
    if (explained) {
      sums.explained += 1.0;
      continue;
    }
    if (valid[i].echo && off_m < -valid[i].tolerance_m) sums.blocked += 1.0;
    if (valid[i].echo && off_m > std::max(well_off_m, valid[i].tolerance_m)) sums.seen_through += 1.0;
  }
  const auto count = static_cast<double>(valid.size());
  return {.explained = sums.explained / count,
          .blocked = sums.blocked / count,
          .seen_through = sums.seen_through / count,
          .held_m2 = held_m2(contour, echo_explained)};
}

}  // namespace

std::vector<Verification> verify(const PreparedState& map, const Scan& scan,
                                 std::span<const Pose2> T_map_robot) {
  const std::vector<ValidBeam> valid = valid_beams(scan, map.grid().resolution_m);
  std::vector<Verification> answers(T_map_robot.size());
  if (valid.empty() || T_map_robot.empty()) return answers;
  const std::vector<raycast::Beam> all = to_raycast(*scan.sensor);
  std::vector<raycast::Beam> beams;
  beams.reserve(valid.size());
  for (const ValidBeam& beam : valid) beams.push_back(all[beam.beam]);
  std::vector<raycast::Pose> poses;
  poses.reserve(T_map_robot.size());
  for (const Pose2& pose : T_map_robot) poses.push_back(to_raycast(pose));
  std::vector<float> simulated_m(poses.size() * beams.size());
  map.scene().cast_fans(poses, beams, simulated_m);
  const std::vector<ContourPiece> contour = contour_of(scan, valid);
  for (std::size_t p = 0; p < poses.size(); ++p) {
    const auto of_pose = std::span<const float>(simulated_m).subspan(p * beams.size(), beams.size());
    answers[p] = judge(map, *scan.sensor, T_map_robot[p], valid, contour, of_pose);
  }
  return answers;
}

}  // namespace landfall::internal
