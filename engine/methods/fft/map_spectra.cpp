#include "engine/methods/fft/map_spectra.hpp"

#include <algorithm>
#include <cmath>

namespace landfall::internal {

MapSpectra::MapSpectra(std::span<const float> field, const CorrelationTiles& tiles)
    : tiles_(tiles), fft_(shared_fft(tiles.fft_rows, tiles.fft_cols)) {
  Plane plane(fft_->reals());
  const float scale = 1.0F / static_cast<float>(fft_->reals());
  for (int tile = 0; tile < tiles_.count(); ++tile) {
    fill(field, tile, plane);
    Spectrum& spectrum = spectra_.emplace_back(fft_->bins());
    fft_->forward(plane, spectrum);
    for (std::complex<float>& bin : spectrum) bin *= scale;
  }
}

// The cells within reach of the tile's poses; those left of it and below wrap to the plane's far end, as end
// points do.
void MapSpectra::fill(std::span<const float> field, int tile, Plane& plane) {
  std::fill(plane.begin(), plane.end(), 0.0F);
  double squares = 0.0;
  const int col0 = tiles_.first_col(tile);
  const int row0 = tiles_.first_row(tile);
  const int last_row = std::min(tiles_.height_cells, row0 + tiles_.tile_height_cells + tiles_.reach_cells);
  const int last_col = std::min(tiles_.width_cells, col0 + tiles_.tile_width_cells + tiles_.reach_cells);
  for (int row = std::max(0, row0 - tiles_.reach_cells); row < last_row; ++row) {
    const int y = (row - row0 + tiles_.fft_rows) % tiles_.fft_rows;
    for (int col = std::max(0, col0 - tiles_.reach_cells); col < last_col; ++col) {
      const int x = (col - col0 + tiles_.fft_cols) % tiles_.fft_cols;
      const float value = field[static_cast<std::size_t>(row) * static_cast<std::size_t>(tiles_.width_cells) +
                                static_cast<std::size_t>(col)];
      plane[static_cast<std::size_t>(y) * static_cast<std::size_t>(tiles_.fft_cols) +
            static_cast<std::size_t>(x)] = value;
      squares += static_cast<double>(value) * static_cast<double>(value);
    }
  }
  field_norm_ = std::max(field_norm_, std::sqrt(squares));
}

// Higham, Accuracy and Stability of Numerical Algorithms, theorem 24.2: a transform of n values is off by at
// most log2(n) eta of its norm, eta = u + 4u (sqrt(2) + u). Twice before the product, where both norms
// multiply (Cauchy and Schwarz), once after it, where the sums' norm is at most points x field's.
double MapSpectra::error_bound(double points, double points_norm) const {
  constexpr double unit_roundoff = 0x1p-24;
  constexpr double eta = 7.0 * unit_roundoff;
  constexpr double product = 4.0 * unit_roundoff;  // of complex numbers, scaled
  const double transform = eta * std::log2(static_cast<double>(fft_->reals()));
  return field_norm_ * ((2.0 * transform + product) * points_norm + transform * points);
}

std::size_t MapSpectra::memory_bytes() const {
  std::size_t bytes = 0;
  for (const Spectrum& spectrum : spectra_) bytes += sizeof(std::complex<float>) * spectrum.capacity();
  return bytes;
}

}  // namespace landfall::internal
