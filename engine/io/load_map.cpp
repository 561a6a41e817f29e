#include "engine/io/file.hpp"
#include "engine/io/place.hpp"
#include "landfall/io.hpp"

namespace landfall {

namespace {

std::string name_of(const std::filesystem::path& path) {
  const std::string stem = path.stem().string();
  return stem == "map" ? std::filesystem::absolute(path).parent_path().filename().string() : stem;
}

}  // namespace

PreparedMap load_map(const std::filesystem::path& path, const LoadMapOptions& options) {
  const std::string extension = io::text_extension(path);
  PrepareOptions prepare = options.prepare;
  if (prepare.name.empty()) prepare.name = name_of(path);
  if (extension == ".yaml" || extension == ".yml") return PreparedMap(load_grid_map(path), prepare);
  if (extension == ".json") return PreparedMap(load_wall_map(path), options.walls, prepare);
  io::fail_format({path.string()}, "", "ending " + io::shown(extension),
                  ".yaml or .yml (a ROS map) or .json (a wall plan)");
}

}  // namespace landfall
