#include "engine/methods/sdn/test_rays.hpp"

#include <array>
#include <cassert>
#include <cmath>

#include "engine/maps/to_raycast.hpp"

namespace landfall::internal {

TestRays::TestRays(const PreparedState& map, const Scan& scan, const BeamBands& bands)
    : scene_(map.scene()), bands_(bands) {
  const std::vector<raycast::Beam> all = to_raycast(*scan.sensor);
  for (std::size_t i = 0; i < bands.size(); ++i) {
    const raycast::Beam& beam = all[bands.sensor_beam(i)];
    beams_.push_back(beam);
    directions_.push_back({.x = static_cast<float>(beam.x_m),
                           .y = static_cast<float>(beam.y_m),
                           .dx = static_cast<float>(std::cos(beam.theta_rad)),
                           .dy = static_cast<float>(std::sin(beam.theta_rad)),
                           .range_max = static_cast<float>(beam.range_max_m)});
    cones_ = cones_ || beam.half_angle_rad > 0.0;
  }
}

void TestRays::cast(std::span<const Test> tests, std::span<float> ranges_m) const {
  assert(tests.size() <= most_tests);
  std::array<raycast::Ray, most_tests> rays;
  for (std::size_t i = 0; i < tests.size(); ++i) {
    const Pose2& pose = tests[i].T_map_robot;
    const auto theta = static_cast<float>(pose.theta_rad);
    const float c = std::cos(theta);
    const float s = std::sin(theta);
    const Direction& beam = directions_[tests[i].beam];
    rays[i] = {.x_m = pose.x_m + static_cast<double>(c * beam.x - s * beam.y),
               .y_m = pose.y_m + static_cast<double>(s * beam.x + c * beam.y),
               .dx = c * beam.dx - s * beam.dy,
               .dy = s * beam.dx + c * beam.dy,
               .range_max_m = beam.range_max};
  }
  scene_.cast_rays(std::span(rays).first(tests.size()), ranges_m.first(tests.size()));
  if (cones_) cast_cones(tests, ranges_m);
}

void TestRays::cast_cones(std::span<const Test> tests, std::span<float> ranges_m) const {
  for (std::size_t i = 0; i < tests.size(); ++i) {
    const raycast::Beam& beam = beams_[tests[i].beam];
    if (beam.half_angle_rad <= 0.0) continue;
    const raycast::Pose pose = to_raycast(tests[i].T_map_robot);
    scene_.cast_fans(std::span(&pose, 1), std::span(&beam, 1), ranges_m.subspan(i, 1));
  }
}

int TestRays::count_agreeing(const Pose2& T_map_robot, std::size_t level) const {
  const raycast::Pose pose = to_raycast(T_map_robot);
  std::vector<float> ranges_m(beams_.size());
  scene_.cast_fans(std::span(&pose, 1), beams_, ranges_m);
  int agreeing = 0;
  for (std::size_t i = 0; i < ranges_m.size(); ++i)
    agreeing += bands_.band(level, i).contains(ranges_m[i]) ? 1 : 0;
  return agreeing;
}

}  // namespace landfall::internal
