#include "landfall/wall_map.hpp"

#include <cmath>
#include <cstddef>
#include <string>

#include "engine/base/number_text.hpp"
#include "landfall/error.hpp"

namespace landfall {

void validate(const WallMap& map) {
  if (map.walls.empty())
    throw Error(ErrorCode::invalid_argument, "wall map: no walls, expected at least one");
  for (std::size_t i = 0; i < map.walls.size(); ++i) {
    const auto& [a_map, b_map] = map.walls[i];
    for (const double value : {a_map.x_m, a_map.y_m, b_map.x_m, b_map.y_m})
      if (!std::isfinite(value))
        throw Error(ErrorCode::invalid_argument, "wall map: wall " + std::to_string(i) +
                                                     " has the coordinate " + number_text(value) +
                                                     ", expected finite numbers");
  }
}

}  // namespace landfall
