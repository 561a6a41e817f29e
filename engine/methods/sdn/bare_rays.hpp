// The raycaster alone, beside which the networks' rays are measured.
#pragma once

#include <span>

#include "landfall/prepared_map.hpp"
#include "landfall/sensor.hpp"

namespace landfall::internal {

// Processor time in seconds for casting ray i, beam i % beams of a sensor without half-angles, from
// T_map_robot[i]: in one thread, rays that have nothing in common.
double time_bare_rays(const PreparedMap& map, const Sensor& sensor, std::span<const Pose2> T_map_robot);

}  // namespace landfall::internal
