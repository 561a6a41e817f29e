#include "engine/io/file.hpp"
#include "engine/io/place.hpp"
#include "landfall/io.hpp"

namespace landfall {

PreparedMap load_map(const std::filesystem::path& path, const LoadMapOptions& options) {
  const std::string extension = io::text_extension(path);
  if (extension == ".yaml" || extension == ".yml") return PreparedMap(load_grid_map(path), options.prepare);
  if (extension == ".json") return PreparedMap(load_wall_map(path), options.walls, options.prepare);
  io::fail_format({path.string()}, "", "ending " + io::shown(extension),
                  ".yaml or .yml (a ROS map) or .json (a wall plan)");
}

}  // namespace landfall
