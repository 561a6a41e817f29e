#include "landfall/simulate.hpp"

#include <algorithm>
#include <iterator>

#include "bindings/c/handles.hpp"

namespace {

using landfall::c::array;
using landfall::c::from_c;
using landfall::c::guarded;
using landfall::c::required;

}  // namespace

landfall_status landfall_simulate_ranges(const landfall_map* map, const landfall_sensor* sensor,
                                         const landfall_pose* T_map_robot, size_t pose_count, float* ranges_m,
                                         size_t range_count) {
  return guarded(__func__, [&] {
    const landfall::Sensor& source = *required(sensor, "sensor").sensor;
    const std::size_t beams = source.beams.size();
    if (range_count / beams != pose_count || range_count % beams != 0)
      landfall::c::refuse("range_count is " + std::to_string(range_count) + ", expected " +
                          std::to_string(pose_count) + " poses x " + std::to_string(beams) + " beams");
    const auto poses = from_c(array(T_map_robot, pose_count, "T_map_robot"));
    array(ranges_m, range_count, "ranges_m");
    const auto simulated = landfall::simulate_ranges(required(map, "map").map, source, poses);
    std::copy(simulated.begin(), simulated.end(), ranges_m);
  });
}

landfall_status landfall_simulate(const landfall_map* map, const landfall_sensor* sensor,
                                  const landfall_pose* T_map_robot, size_t pose_count, uint64_t seed,
                                  landfall_scans* scans) {
  return guarded(__func__, [&] {
    auto& list = required(scans, "scans").scans;
    const auto poses = from_c(array(T_map_robot, pose_count, "T_map_robot"));
    auto simulated = landfall::simulate(required(map, "map").map, required(sensor, "sensor").sensor, poses,
                                        {.noise = true, .seed = seed});
    list.insert(list.end(), std::make_move_iterator(simulated.begin()),
                std::make_move_iterator(simulated.end()));
  });
}
