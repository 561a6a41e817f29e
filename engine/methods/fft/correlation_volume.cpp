#include <algorithm>
#include <atomic>
#include <cmath>
#include <memory>
#include <string>

#include "engine/base/options.hpp"
#include "engine/base/parallel.hpp"
#include "engine/maps/prepared_state.hpp"
#include "engine/methods/fft/correlation_search.hpp"
#include "engine/methods/fft/correlator.hpp"
#include "engine/priors/lattice.hpp"
#include "engine/scans/end_points.hpp"
#include "landfall/correlation.hpp"
#include "landfall/error.hpp"

namespace landfall {
namespace internal {
namespace {

constexpr std::uint64_t max_scores = std::uint64_t{1} << 32;

CorrelationVolume empty_volume(const Lattice& lattice, const CorrelationTiles& tiles) {
  const auto cells =
      static_cast<std::uint64_t>(lattice.width_cells) * static_cast<std::uint64_t>(lattice.height_cells);
  const std::uint64_t scores = cells * static_cast<std::uint64_t>(lattice.headings);
  if (scores > max_scores)
    throw Error(ErrorCode::too_large, "correlation volume of " + std::to_string(lattice.headings) + " x " +
                                          std::to_string(lattice.height_cells) + " x " +
                                          std::to_string(lattice.width_cells) + " scores, at most " +
                                          std::to_string(max_scores) + " are allowed");
  return {.headings = lattice.headings,
          .height_cells = lattice.height_cells,
          .width_cells = lattice.width_cells,
          .scores = std::vector<float>(scores),
          .transform_rows = tiles.fft_rows,
          .transform_cols = tiles.fft_cols};
}

void copy_tile(const Correlator& correlator, const CorrelationTiles& tiles, int tile, float* plane) {
  const int row0 = tiles.first_row(tile);
  const int col0 = tiles.first_col(tile);
  const int rows = std::min(tiles.tile_height_cells, tiles.height_cells - row0);
  const int cols = std::min(tiles.tile_width_cells, tiles.width_cells - col0);
  for (int row = 0; row < rows; ++row)
    std::copy_n(
        correlator.sums() + static_cast<std::size_t>(row) * correlator.stride(), cols,
        plane + static_cast<std::size_t>(row0 + row) * static_cast<std::size_t>(tiles.width_cells) + col0);
}

CorrelationVolume volume_of(const MapSpectra& spectra, const EndPoints& points, const Lattice& lattice,
                            int threads) {
  const CorrelationTiles& tiles = spectra.tiles();
  CorrelationVolume volume = empty_volume(lattice, tiles);
  const std::size_t cells =
      static_cast<std::size_t>(lattice.width_cells) * static_cast<std::size_t>(lattice.height_cells);
  std::vector<double> error_bounds(static_cast<std::size_t>(lattice.headings));
  std::atomic<int> next{0};
  const auto workers = static_cast<std::size_t>(std::clamp(thread_count(threads), 1, lattice.headings));
  parallel_for(workers, threads, [&](std::size_t) {
    Correlator correlator(spectra);
    HeadingCells drawn;
    for (int heading = next++; heading < lattice.headings; heading = next++) {
      const auto k = static_cast<std::size_t>(heading);
      cells_at_heading(points, lattice, heading, drawn);
      correlator.draw(drawn);
      error_bounds[k] = correlator.error_bound();
      for (int tile = 0; tile < tiles.count(); ++tile) {
        correlator.correlate(tile);
        copy_tile(correlator, tiles, tile, volume.scores.data() + k * cells);
      }
    }
  });
  volume.error_bound = *std::max_element(error_bounds.begin(), error_bounds.end());
  return volume;
}

void check_values(std::span<const float> values, const GridMap& grid) {
  if (values.size() != grid.cells.size())
    throw Error(ErrorCode::invalid_argument, "correlation: " + std::to_string(values.size()) +
                                                 " values, expected one per cell (" +
                                                 std::to_string(grid.cells.size()) + ")");
  if (!std::all_of(values.begin(), values.end(), [](float value) { return std::isfinite(value); }))
    throw Error(ErrorCode::invalid_argument, "correlation: a value is not finite");
}

}  // namespace
}  // namespace internal

CorrelationVolume correlation_volume(const PreparedMap& map, const Scan& scan,
                                     const CorrelationOptions& options) {
  internal::validate_environment();
  validate(scan);
  const internal::Lattice lattice = internal::make_lattice(map.grid(), 0.0, options.rotation_step_rad);
  const internal::EndPoints points = internal::make_end_points(scan, map.grid().resolution_m);
  const auto spectra = map.state().field_spectra(internal::reach_cells(points));
  return internal::volume_of(*spectra, points, lattice, options.threads);
}

CorrelationVolume correlation_volume(const GridMap& grid, std::span<const float> values, const Scan& scan,
                                     const CorrelationOptions& options) {
  internal::validate_environment();
  validate(grid);
  validate(scan);
  internal::check_values(values, grid);
  const internal::Lattice lattice = internal::make_lattice(grid, 0.0, options.rotation_step_rad);
  const internal::EndPoints points = internal::make_end_points(scan, grid.resolution_m);
  const internal::MapSpectra spectra(
      values, internal::choose_tiles(
                  grid.width_cells, grid.height_cells,
                  std::min(internal::reach_cells(points), std::max(grid.width_cells, grid.height_cells))));
  return internal::volume_of(spectra, points, lattice, options.threads);
}

std::string_view transform_library() {
  return internal::RealFft::library();
}

}  // namespace landfall
