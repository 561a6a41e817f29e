// A field's Fourier transform, tile by tile: what all scans and headings are correlated with.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "engine/methods/fft/real_fft.hpp"
#include "engine/methods/fft/tiles.hpp"

namespace landfall::internal {

// Immutable after construction.
class MapSpectra {
 public:
  // field: row by row, of the tiles' map.
  MapSpectra(std::span<const float> field, const CorrelationTiles& tiles);

  [[nodiscard]] const CorrelationTiles& tiles() const { return tiles_; }
  [[nodiscard]] const RealFft& fft() const { return *fft_; }
  // Divided by what the transforms leave to us.
  [[nodiscard]] const Spectrum& of_tile(int tile) const { return spectra_[static_cast<std::size_t>(tile)]; }
  // No sum of these points by transforms is farther than this from the exact one. points_norm: root of the
  // sum of the squared counts of the cells.
  [[nodiscard]] double error_bound(double points, double points_norm) const;
  [[nodiscard]] std::size_t memory_bytes() const;

 private:
  void fill(std::span<const float> field, int tile, Plane& plane);

  CorrelationTiles tiles_;
  std::shared_ptr<const RealFft> fft_;
  std::vector<Spectrum> spectra_;
  double field_norm_ = 0.0;  // largest of a tile: root of the sum of squares
};

}  // namespace landfall::internal
