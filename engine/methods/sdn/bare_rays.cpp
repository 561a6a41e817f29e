#include "engine/methods/sdn/bare_rays.hpp"

#include <cmath>
#include <vector>

#include "engine/base/thread_time.hpp"
#include "engine/maps/prepared_state.hpp"
#include "engine/maps/to_raycast.hpp"

namespace landfall::internal {

double time_bare_rays(const PreparedMap& map, const Sensor& sensor, std::span<const Pose2> T_map_robot) {
  validate(sensor);
  const raycast::Scene& scene = map.state().scene();
  const std::vector<raycast::Beam> beams = to_raycast(sensor);
  std::vector<raycast::Ray> rays;
  for (std::size_t i = 0; i < T_map_robot.size(); ++i) {
    const raycast::Beam& beam = beams[i % beams.size()];
    const Pose2 T_map_beam = T_map_robot[i] * Pose2{beam.x_m, beam.y_m, beam.theta_rad};
    rays.push_back({.x_m = T_map_beam.x_m,
                    .y_m = T_map_beam.y_m,
                    .dx = static_cast<float>(std::cos(T_map_beam.theta_rad)),
                    .dy = static_cast<float>(std::sin(T_map_beam.theta_rad)),
                    .range_max_m = static_cast<float>(beam.range_max_m)});
  }
  std::vector<float> ranges_m(rays.size());
  const double start_ms = thread_time_ms();
  scene.cast_rays(rays, ranges_m);
  return 1e-3 * (thread_time_ms() - start_ms);
}

}  // namespace landfall::internal
