// The whole volume of scores over x, y and heading, by Fourier transforms, for those who want to see all of
// it; search() with method `fft` finds its maxima without storing it.
#pragma once

#include <cstddef>
#include <numbers>
#include <span>
#include <string_view>
#include <vector>

#include "landfall/prepared_map.hpp"
#include "landfall/scan.hpp"

namespace landfall {

struct CorrelationOptions {
  double rotation_step_rad = std::numbers::pi / 360.0;  // as in SearchOptions
  int threads = 0;                                      // 0: all
};

// Heading k is k 2 pi / headings in the grid's own frame; the robot stands in the centre of a cell, free or
// not.
struct CorrelationVolume {
  int headings = 0;
  int height_cells = 0;
  int width_cells = 0;
  std::vector<float> scores;  // [heading][row][column]; by FFTW they differ from run to run, within the bound
  double error_bound = 0.0;   // no score is farther from the exact sum
  int transform_rows = 0;     // size of the transforms
  int transform_cols = 0;

  [[nodiscard]] float at(int heading, CellIndex cell) const {
    return scores[(static_cast<std::size_t>(heading) * static_cast<std::size_t>(height_cells) +
                   static_cast<std::size_t>(cell.row)) *
                      static_cast<std::size_t>(width_cells) +
                  static_cast<std::size_t>(cell.col)];
  }
};

// The sum, over the scan's echoes, of the likelihood field where they end (0 outside the map).
// Throws Error{invalid_argument}: a scan that does not validate, a rotation step as in search();
// Error{too_large}: more than 2^32 scores.
CorrelationVolume correlation_volume(const PreparedMap& map, const Scan& scan,
                                     const CorrelationOptions& options = {});
// The same over any finite values, one per cell of the grid, row by row.
CorrelationVolume correlation_volume(const GridMap& grid, std::span<const float> values, const Scan& scan,
                                     const CorrelationOptions& options = {});

// "fftw" or "eigen": -DLANDFALL_FFT of the build.
std::string_view transform_library();

}  // namespace landfall
