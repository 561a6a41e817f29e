// Files in and out. Every reader throws Error{file_not_found, file_format, too_large} that names the
// file, line, field, the value found and what was expected; every writer writes to a temporary name
// and renames. Formats: docs/formats.md.
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "landfall/grid_map.hpp"
#include "landfall/prepared_map.hpp"
#include "landfall/prior.hpp"
#include "landfall/scan.hpp"
#include "landfall/search.hpp"
#include "landfall/sensor.hpp"
#include "landfall/wall_map.hpp"

namespace landfall {

// ROS map_server yaml with its image (pgm P2/P5, ppm P3/P6, png; trinary, scale and raw modes).
GridMap load_grid_map(const std::filesystem::path& yaml);
// Writes yaml and, beside it, a pgm (trinary: occupied 0, unknown 205, free 254).
void save_grid_map(const GridMap& map, const std::filesystem::path& yaml);
// A plan as JSON: {"units": "m", "walls": [[x1, y1, x2, y2], ...]}; units m, cm or mm.
WallMap load_wall_map(const std::filesystem::path& json);
void save_wall_map(const WallMap& map, const std::filesystem::path& json);
// Either kind, told by the file's ending, ready to search. Without a name of its own the map has the file's,
// without the ending, or its folder's where that is plain "map".
struct LoadMapOptions {
  GridFromWallsOptions walls;
  PrepareOptions prepare;
};
PreparedMap load_map(const std::filesystem::path& path, const LoadMapOptions& options = {});

// The sensors a file defines, by name: yaml, or the sensor lines of a .jsonl log.
std::map<std::string, std::shared_ptr<const Sensor>> load_sensors(const std::filesystem::path& path);
void save_sensor(const Sensor& sensor, const std::filesystem::path& yaml);

struct LoadLogOptions {
  // Replaces what the log implies: sensors by the log's own names (CARMEN: "front_laser",
  // "rear_laser", "sonar"; scan lines: their `sensor`).
  std::map<std::string, std::shared_ptr<const Sensor>> sensors;
};
struct Log {
  std::vector<Scan> scans;
  std::vector<std::string> warnings;  // readings that were passed over, with file, line and reason
};
// CARMEN text (.log, .clf, gzipped or not), scan lines (.jsonl, gzipped or not), sonar tables
// (corridor8_ranges.txt with corridor8_poses.txt beside it; scitos24 csv): told by content. Scans of one
// geometry share their sensor.
Log load_log(const std::filesystem::path& path, const LoadLogOptions& options = {});
// Scan lines: each sensor before its first scan, then one line per scan. Gzipped where it ends in .gz.
void save_log(std::span<const Scan> scans, const std::filesystem::path& jsonl);

struct StampedPose {
  double stamp_s = 0.0;
  Pose2 pose;
};
std::vector<StampedPose> load_trajectory(const std::filesystem::path& tum);
void save_trajectory(std::span<const StampedPose> poses, const std::filesystem::path& tum);

// A prior as JSON that mirrors the C++ types: {"window": {...}}, {"mixture": [...]}; docs/formats.md.
PosePrior load_prior(const std::filesystem::path& json);
// Named places of a map, each a Region or a Window: {kitchen: {polygon_map: [[x, y], ...]}, door:
// {T_map_robot: [x, y, theta], half_x_m: ...}} as yaml; docs/formats.md.
std::map<std::string, PosePrior> load_places(const std::filesystem::path& yaml);

// One results.jsonl line, without the line end.
std::string to_json_line(const SearchResult& result, std::size_t index);

}  // namespace landfall
