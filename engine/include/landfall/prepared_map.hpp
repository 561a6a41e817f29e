// Everything derived from a map. Parts are built on first need, each once; immutable and safe to
// share between threads afterwards. Copies share one state.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "landfall/grid_map.hpp"
#include "landfall/wall_map.hpp"

namespace landfall {

struct PrepareOptions {
  double field_sigma_m = 0.1;      // likelihood field: 255 exp(-d^2 / (2 sigma^2)), d to the nearest
                                   // occupied cell's centre
  std::uint8_t unknown_value = 0;  // the least field value of unknown cells (0: unknown explains nothing)
  std::string name;                // shown in reports where several maps are searched
};

namespace internal {
class PreparedState;
}

class PreparedMap {
 public:
  // Throws Error where validate(map) does, and Error{invalid_argument} for a field_sigma_m that is not above
  // 0 and at most a thousand cells.
  explicit PreparedMap(GridMap map, PrepareOptions options = {});
  // A plan is searched on its grid (`grid` options) and verified against its own exact walls. Throws as the
  // other does, and as to_grid().
  explicit PreparedMap(WallMap walls, GridFromWallsOptions grid = {}, PrepareOptions options = {});

  [[nodiscard]] const GridMap& grid() const;
  [[nodiscard]] const PrepareOptions& options() const;
  // Squared distance of each cell's centre to the nearest occupied cell's centre, in cells, exact
  // (Felzenszwalb & Huttenlocher 2012) up to 2^30, which is also that of a map without any. Row by row.
  [[nodiscard]] std::span<const std::int32_t> squared_distance_cells() const;
  // The likelihood field, row by row, one byte a cell.
  [[nodiscard]] std::span<const std::uint8_t> field() const;
  // The walls that rays are cast against: the plan's own, or the grid's merged faces.
  [[nodiscard]] const WallMap& walls() const;
  // Builds all that the default search needs now rather than on first use.
  void prepare() const;
  // Bytes held by what has been built so far.
  [[nodiscard]] std::size_t memory_bytes() const;

  [[nodiscard]] const internal::PreparedState& state() const { return *state_; }

 private:
  std::shared_ptr<const internal::PreparedState> state_;
};

}  // namespace landfall
