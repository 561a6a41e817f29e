// What a PreparedMap holds: parts that are built on first need, each once.
#pragma once

#include <atomic>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "engine/maps/search_tables.hpp"
#include "engine/methods/fft/map_spectra.hpp"
#include "engine/methods/grid/global_grid.hpp"
#include "engine/methods/pso/occupied_bits.hpp"
#include "engine/priors/block_mask.hpp"
#include "engine/priors/tile_layout.hpp"
#include "engine/scan_matching/icp.hpp"
#include "landfall/prepared_map.hpp"
#include "raycast/scene.hpp"

namespace landfall::internal {

// Built by the first caller; everyone else waits for it or finds it there.
template <class T>
class Lazy {
 public:
  template <class Build>
  const T& get(const Build& build) const {
    std::call_once(once_, [&] {
      value_.emplace(build());
      built_.store(true, std::memory_order_release);
    });
    return *value_;
  }
  [[nodiscard]] const T* if_built() const {
    return built_.load(std::memory_order_acquire) ? &*value_ : nullptr;
  }

 private:
  mutable std::once_flag once_;
  mutable std::optional<T> value_;
  mutable std::atomic<bool> built_{false};
};

class PreparedState {
 public:
  PreparedState(GridMap grid, std::optional<WallMap> walls, PrepareOptions options);

  [[nodiscard]] const GridMap& grid() const { return grid_; }
  [[nodiscard]] const PrepareOptions& options() const { return options_; }
  [[nodiscard]] const std::vector<std::int32_t>& squared_distance_cells() const;
  [[nodiscard]] const std::vector<std::uint8_t>& field() const;
  [[nodiscard]] const WindowTables& window_tables() const;
  // Blocks of kernels::block_cells.
  [[nodiscard]] const BoundTable& bound_table() const;
  // Blocks twice as large.
  [[nodiscard]] const BoundTable& coarse_bound_table() const;
  // Of method `grid`.
  [[nodiscard]] const std::vector<std::int8_t>& global_grid(Contours contours) const;
  // The same, corrected, drawn in cells `factor` times as large (grid/reduced.hpp).
  [[nodiscard]] const std::vector<std::int8_t>& reduced_grid(int factor) const;
  // The field's, for end points that are up to reach_cells away from the robot's cell along either axis.
  [[nodiscard]] std::shared_ptr<const MapSpectra> field_spectra(int reach_cells) const;
  // Of method `pso`.
  [[nodiscard]] const OccupiedBits& occupied_bits() const;
  // Of methods `icp`: the centres of occupied cells, in the map's frame, with normals.
  [[nodiscard]] const IcpTarget& icp_target() const;
  [[nodiscard]] const WallMap& walls() const;
  // Made from a floor plan, whose walls are exact.
  [[nodiscard]] bool is_plan() const { return plan_.has_value(); }
  // The map, in its own frame, ready for rays: a plan by its walls, a grid in the way that is the fastest.
  [[nodiscard]] const raycast::Scene& scene() const;
  // Cells where a robot of this radius may stand, on every step_cells-th column and row.
  [[nodiscard]] SharedMask free_mask(double robot_radius_m, int step_cells) const;
  // The tiles over such a mask, built on first need; null where the mask is another.
  [[nodiscard]] const SearchTiles* tiles_of(const SharedMask& free) const;
  [[nodiscard]] std::size_t memory_bytes() const;

 private:
  GridMap grid_;
  PrepareOptions options_;
  std::optional<WallMap> plan_;
  Lazy<std::vector<std::int32_t>> squared_distance_cells_;
  Lazy<std::vector<std::uint8_t>> field_;
  Lazy<WindowTables> window_tables_;
  Lazy<BoundTable> bound_table_;
  Lazy<BoundTable> coarse_bound_table_;
  Lazy<std::vector<std::int8_t>> corrected_grid_;
  Lazy<std::vector<std::int8_t>> uncorrected_grid_;
  Lazy<OccupiedBits> occupied_bits_;
  Lazy<IcpTarget> icp_target_;
  Lazy<WallMap> walls_;
  Lazy<raycast::Scene> scene_;
  mutable std::mutex reduced_mutex_;
  mutable std::map<int, std::vector<std::int8_t>> reduced_grids_;  // by factor
  mutable std::mutex spectra_mutex_;
  mutable std::map<int, std::shared_ptr<const MapSpectra>> spectra_;  // by reach
  mutable std::mutex masks_mutex_;
  struct FreeCells {
    SharedMask mask;
    Lazy<SearchTiles> tiles;
  };
  mutable std::map<std::pair<double, int>, FreeCells> free_cells_;  // by radius in metres and step in cells
};

}  // namespace landfall::internal
