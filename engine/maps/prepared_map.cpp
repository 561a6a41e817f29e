#include "landfall/prepared_map.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "engine/base/number_text.hpp"
#include "engine/base/options.hpp"
#include "engine/maps/distance_field.hpp"
#include "engine/maps/prepared_state.hpp"
#include "engine/maps/to_raycast.hpp"
#include "engine/methods/grid/reduced.hpp"
#include "landfall/error.hpp"
#include "landfall/search.hpp"

namespace landfall {
namespace internal {
namespace {

std::vector<Point2> occupied_centers(const GridMap& grid) {
  std::vector<Point2> points;
  for (int row = 0; row < grid.height_cells; ++row)
    for (int col = 0; col < grid.width_cells; ++col)
      if (grid.at({.col = col, .row = row}) == Occupancy::occupied)
        points.push_back(grid.center_of({.col = col, .row = row}));
  return points;
}

}  // namespace

PreparedState::PreparedState(GridMap grid, std::optional<WallMap> walls, PrepareOptions options)
    : grid_(std::move(grid)), options_(std::move(options)), plan_(std::move(walls)) {
  validate(grid_);
  const double most_sigma_m = 1000.0 * grid_.resolution_m;
  if (!(options_.field_sigma_m > 0.0) || !(options_.field_sigma_m <= most_sigma_m))
    throw Error(ErrorCode::invalid_argument,
                "option field_sigma_m is " + number_text(options_.field_sigma_m) +
                    ", expected more than 0 and at most " + number_text(most_sigma_m));
}

const std::vector<std::int32_t>& PreparedState::squared_distance_cells() const {
  return squared_distance_cells_.get([this] {
    std::vector<std::uint8_t> occupied;
    occupied.reserve(grid_.cells.size());
    for (const Occupancy cell : grid_.cells) occupied.push_back(cell == Occupancy::occupied ? 1 : 0);
    return squared_distances(occupied, grid_.width_cells, grid_.height_cells);
  });
}

const std::vector<std::uint8_t>& PreparedState::field() const {
  return field_.get(
      [this] { return likelihood_field(grid_, options_.field_sigma_m, options_.unknown_value); });
}

const WindowTables& PreparedState::window_tables() const {
  return window_tables_.get(
      [this] { return make_window_tables(field(), grid_.width_cells, grid_.height_cells); });
}

const BoundTable& PreparedState::bound_table() const {
  return bound_table_.get([this] {
    return make_bound_table(field(), grid_.width_cells, grid_.height_cells, kernels::block_cells);
  });
}

const BoundTable& PreparedState::coarse_bound_table() const {
  return coarse_bound_table_.get([this] {
    return make_bound_table(field(), grid_.width_cells, grid_.height_cells, 2 * kernels::block_cells);
  });
}

const std::vector<std::int8_t>& PreparedState::global_grid(Contours contours) const {
  const auto& grid = contours == Contours::corrected ? corrected_grid_ : uncorrected_grid_;
  return grid.get([this, contours] { return internal::global_grid(grid_, contours); });
}

const std::vector<std::int8_t>& PreparedState::reduced_grid(int factor) const {
  if (factor == 1) return global_grid(Contours::corrected);
  const std::scoped_lock lock(reduced_mutex_);
  std::vector<std::int8_t>& reduced = reduced_grids_[factor];
  if (reduced.empty()) reduced = internal::global_grid(draw_reduced(grid_, factor), Contours::corrected);
  return reduced;
}

std::shared_ptr<const MapSpectra> PreparedState::field_spectra(int reach_cells) const {
  const int reach = prepared_reach(grid_.width_cells, grid_.height_cells, reach_cells);
  const std::vector<std::uint8_t>& values = field();
  const std::scoped_lock lock(spectra_mutex_);
  std::shared_ptr<const MapSpectra>& spectra = spectra_[reach];
  if (spectra == nullptr)
    spectra = std::make_shared<const MapSpectra>(std::vector<float>(values.begin(), values.end()),
                                                 choose_tiles(grid_.width_cells, grid_.height_cells, reach));
  return spectra;
}

const OccupiedBits& PreparedState::occupied_bits() const {
  return occupied_bits_.get([this] { return internal::occupied_bits(grid_); });
}

const IcpTarget& PreparedState::icp_target() const {
  return icp_target_.get([this] { return IcpTarget(occupied_centers(grid_), true); });
}

const WallMap& PreparedState::walls() const {
  return plan_ ? *plan_ : walls_.get([this] { return to_walls(grid_); });
}

const raycast::Scene& PreparedState::scene() const {
  return scene_.get([this] {
    (void)active_isa();  // rays are cast by kernels
    return plan_ ? raycast::Scene(to_raycast(*plan_))
                 : raycast::Scene(to_raycast(grid_), [this] { return to_raycast(walls()); });
  });
}

SharedMask PreparedState::free_mask(double robot_radius_m, int step_cells) const {
  const std::scoped_lock lock(masks_mutex_);
  SharedMask& mask = free_cells_[{robot_radius_m, step_cells}].mask;
  if (mask != nullptr) return mask;
  std::vector<std::int32_t> clearance;  // squared distance to the nearest cell that is not free
  const double radius_cells = robot_radius_m / grid_.resolution_m;
  if (robot_radius_m > 0.0) {
    std::vector<std::uint8_t> blocked;
    blocked.reserve(grid_.cells.size());
    for (const Occupancy cell : grid_.cells) blocked.push_back(cell == Occupancy::free ? 0 : 1);
    clearance = squared_distances(blocked, grid_.width_cells, grid_.height_cells);
  }
  BlockMask cells = make_block_mask(0, 0, grid_.width_cells - 1, grid_.height_cells - 1);
  for (int row = 0; row < grid_.height_cells; row += step_cells) {
    for (int col = 0; col < grid_.width_cells; col += step_cells) {
      const std::size_t i = grid_.index({col, row});
      if (grid_.cells[i] != Occupancy::free) continue;
      if (!clearance.empty() && std::sqrt(static_cast<double>(clearance[i])) <= radius_cells) continue;
      // What lies outside of the map is not known to be free.
      const int border = std::min({col + 1, row + 1, grid_.width_cells - col, grid_.height_cells - row});
      if (robot_radius_m > 0.0 && border <= radius_cells) continue;
      cells.insert(col, row);
    }
  }
  cells.remember_count();
  mask = std::make_shared<const BlockMask>(std::move(cells));
  return mask;
}

const SearchTiles* PreparedState::tiles_of(const SharedMask& free) const {
  const FreeCells* cells = nullptr;
  {
    const std::scoped_lock lock(masks_mutex_);
    for (const auto& [key, known] : free_cells_)
      if (known.mask == free) cells = &known;
  }
  if (cells == nullptr) return nullptr;
  return &cells->tiles.get([&] { return SearchTiles(blocks_of(std::span(&free, 1))); });
}

std::size_t PreparedState::memory_bytes() const {
  std::size_t bytes = grid_.cells.capacity();
  if (const auto* distances = squared_distance_cells_.if_built()) bytes += 4 * distances->capacity();
  if (const auto* field = field_.if_built()) bytes += field->capacity();
  if (const auto* tables = window_tables_.if_built()) bytes += tables->memory_bytes();
  if (const auto* table = bound_table_.if_built()) bytes += table->memory_bytes();
  if (const auto* table = coarse_bound_table_.if_built()) bytes += table->memory_bytes();
  if (const auto* grid = corrected_grid_.if_built()) bytes += grid->capacity();
  if (const auto* grid = uncorrected_grid_.if_built()) bytes += grid->capacity();
  if (const auto* bits = occupied_bits_.if_built()) bytes += 4 * bits->words.capacity();
  if (const auto* target = icp_target_.if_built()) bytes += target->memory_bytes();
  if (const auto* walls = walls_.if_built()) bytes += sizeof(Wall) * walls->walls.capacity();
  if (plan_) bytes += sizeof(Wall) * plan_->walls.capacity();
  if (const auto* scene = scene_.if_built()) bytes += scene->memory_bytes();
  const std::scoped_lock reduced_lock(reduced_mutex_);
  for (const auto& [factor, grid] : reduced_grids_) bytes += grid.capacity();
  const std::scoped_lock spectra_lock(spectra_mutex_);
  for (const auto& [reach, spectra] : spectra_)
    if (spectra != nullptr) bytes += spectra->memory_bytes();  // null: building it failed
  const std::scoped_lock lock(masks_mutex_);
  for (const auto& [key, cells] : free_cells_) {
    if (cells.mask != nullptr) bytes += 8 * cells.mask->words.capacity();
    if (const auto* tiles = cells.tiles.if_built()) bytes += tiles->memory_bytes();
  }
  return bytes;
}

}  // namespace internal

PreparedMap::PreparedMap(GridMap map, PrepareOptions options)
    : state_(std::make_shared<internal::PreparedState>(std::move(map), std::nullopt, std::move(options))) {}

PreparedMap::PreparedMap(WallMap walls, GridFromWallsOptions grid, PrepareOptions options) {
  validate(walls);
  GridMap cells = to_grid(walls, grid);
  state_ = std::make_shared<internal::PreparedState>(std::move(cells), std::move(walls), std::move(options));
}

const GridMap& PreparedMap::grid() const {
  return state_->grid();
}
const PrepareOptions& PreparedMap::options() const {
  return state_->options();
}
std::span<const std::int32_t> PreparedMap::squared_distance_cells() const {
  return state_->squared_distance_cells();
}
std::span<const std::uint8_t> PreparedMap::field() const {
  return state_->field();
}
const WallMap& PreparedMap::walls() const {
  return state_->walls();
}
std::size_t PreparedMap::memory_bytes() const {
  return state_->memory_bytes();
}

void PreparedMap::prepare() const {
  internal::validate_environment();
  (void)state_->window_tables();
  (void)state_->bound_table();
  (void)state_->coarse_bound_table();
  (void)state_->scene();
  (void)state_->free_mask(0.0, 1);
}

}  // namespace landfall
