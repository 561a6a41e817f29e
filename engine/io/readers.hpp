// Every reader on text in memory: what the loaders of io.hpp and the fuzzers call. `file` is the name
// that errors show.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "landfall/io.hpp"

namespace landfall::io {

// `read_image` returns the bytes of the image that the yaml names.
using ReadImage = std::function<std::string(const std::string& image)>;
GridMap read_grid_map(std::string_view yaml, const std::string& file, const ReadImage& read_image);
WallMap read_wall_map(std::string_view json, const std::string& file);

using SensorsByName = std::map<std::string, std::shared_ptr<const Sensor>>;
SensorsByName read_sensors_yaml(std::string_view yaml, const std::string& file);
SensorsByName read_sensor_lines(std::string_view jsonl, const std::string& file);

// A log's text, unpacked, and where it came from.
struct LogSource {
  std::string_view text;
  std::string file;
};
// Told by content, from the table in log_formats.cpp.
Log read_log(const LogSource& source, const LoadLogOptions& options);
Log read_carmen(const LogSource& source, const LoadLogOptions& options);
Log read_scan_lines(const LogSource& source, const LoadLogOptions& options);
Log read_corridor8(const LogSource& source, const LoadLogOptions& options);
Log read_scitos24(const LogSource& source, const LoadLogOptions& options);
// The same with the text of the poses' table; an empty one means that there is none.
Log read_corridor8(const LogSource& ranges, const LogSource& poses, const LoadLogOptions& options);

std::vector<StampedPose> read_trajectory(std::string_view tum, const std::string& file);
PosePrior read_prior(std::string_view json, const std::string& file);
std::map<std::string, PosePrior> read_places(std::string_view yaml, const std::string& file);

}  // namespace landfall::io
