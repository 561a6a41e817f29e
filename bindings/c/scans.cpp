#include <algorithm>
#include <utility>

#include "bindings/c/handles.hpp"
#include "landfall/align.hpp"
#include "landfall/extended_robot.hpp"
#include "landfall/io.hpp"

namespace {

using landfall::c::array;
using landfall::c::from_c;
using landfall::c::guarded;
using landfall::c::required;
using landfall::c::to_c;

struct Window {
  std::span<const landfall::Scan> scans;
  std::size_t reference;  // into these
};

Window window_of(const landfall_scans* list, std::size_t first, std::size_t count, std::size_t reference) {
  const std::span<const landfall::Scan> scans = required(list, "scans").scans;
  if (count == 0 || first >= scans.size() || count > scans.size() - first)
    landfall::c::refuse("scans " + std::to_string(first) + " and " + std::to_string(count) +
                        " from there are asked for, the list has " + std::to_string(scans.size()));
  if (reference < first || reference - first >= count)
    landfall::c::refuse("reference is " + std::to_string(reference) + ", expected " + std::to_string(first) +
                        " to " + std::to_string(first + count - 1));
  return {scans.subspan(first, count), reference - first};
}

}  // namespace

landfall_status landfall_scans_new(landfall_scans** scans) {
  return guarded(__func__, [&] {
    auto*& made = required(scans, "scans");
    made = new landfall_scans{};
  });
}

landfall_status landfall_scans_load(const char* path, landfall_scans** scans) {
  return guarded(__func__, [&] {
    auto*& made = required(scans, "scans");
    made = new landfall_scans{landfall::load_log(&required(path, "path")).scans};
  });
}

landfall_status landfall_scans_save(const landfall_scans* scans, const char* jsonl_path) {
  return guarded(__func__, [&] {
    landfall::save_log(required(scans, "scans").scans, &required(jsonl_path, "jsonl_path"));
  });
}

landfall_status landfall_scans_add(landfall_scans* scans, const landfall_sensor* sensor,
                                   const float* ranges_m, size_t range_count, double stamp_s,
                                   const landfall_pose* T_odom_robot) {
  return guarded(__func__, [&] {
    auto& list = required(scans, "scans").scans;
    const auto ranges = array(ranges_m, range_count, "ranges_m");
    landfall::Scan scan;
    scan.sensor = required(sensor, "sensor").sensor;
    scan.ranges_m.assign(ranges.begin(), ranges.end());
    scan.stamp_s = stamp_s;
    if (T_odom_robot != nullptr) scan.T_odom_robot = from_c(*T_odom_robot);
    validate(scan);
    list.push_back(std::move(scan));
  });
}

size_t landfall_scans_count(const landfall_scans* scans) {
  return scans == nullptr ? 0 : scans->scans.size();
}

landfall_status landfall_scans_get(const landfall_scans* scans, size_t index, landfall_scan* scan) {
  return guarded(__func__, [&] {
    const landfall::Scan& source = window_of(scans, index, 1, index).scans[0];
    required(scan, "scan") = {.stamp_s = source.stamp_s,
                              .ranges_m = source.ranges_m.data(),
                              .range_count = source.ranges_m.size(),
                              .has_odometry = source.T_odom_robot ? 1 : 0,
                              .T_odom_robot = to_c(source.T_odom_robot.value_or(landfall::Pose2{})),
                              .has_pose = source.T_map_robot ? 1 : 0,
                              .T_map_robot = to_c(source.T_map_robot.value_or(landfall::Pose2{}))};
  });
}

landfall_status landfall_scans_align(const landfall_scans* scans, size_t first, size_t count,
                                     size_t reference, landfall_pose* T_reference_robot) {
  return guarded(__func__, [&] {
    required(T_reference_robot, "T_reference_robot");
    const Window window = window_of(scans, first, count, reference);
    const auto aligned = landfall::align(window.scans, window.reference);
    std::transform(aligned.begin(), aligned.end(), T_reference_robot,
                   [](const landfall::Pose2& pose) { return to_c(pose); });
  });
}

landfall_status landfall_scans_merge(const landfall_scans* scans, size_t first, size_t count,
                                     const landfall_pose* T_common_robot, size_t reference,
                                     landfall_scans* merged) {
  return guarded(__func__, [&] {
    auto& list = required(merged, "merged").scans;
    const Window window = window_of(scans, first, count, reference);
    const auto poses = T_common_robot == nullptr ? landfall::odometry_of(window.scans)
                                                 : from_c(array(T_common_robot, count, "T_common_robot"));
    list.push_back(landfall::merge(window.scans, poses, window.reference));
  });
}

landfall_status landfall_scans_merge_turn_minima(const landfall_scans* scans, size_t first, size_t count,
                                                 landfall_scans* condensed) {
  return guarded(__func__, [&] {
    auto& list = required(condensed, "condensed").scans;
    list.push_back(landfall::merge_turn_minima(window_of(scans, first, count, first).scans));
  });
}

void landfall_scans_free(landfall_scans* scans) {
  delete scans;
}
