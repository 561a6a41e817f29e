// One heading at a time: the scan's end points drawn into a plane (Espino's extended robot, A_k) and
// correlated with the field (W), all translations at once. One per thread.
#pragma once

#include "engine/methods/fft/map_spectra.hpp"
#include "engine/scans/end_points.hpp"

namespace landfall::internal {

class Correlator {
 public:
  explicit Correlator(const MapSpectra& spectra);

  // A_k of these end points; the number that may lie on the map at all. Points beyond the spectra's reach
  // must lie outside the map from every pose.
  int draw(const HeadingCells& points);
  // No sum of what is drawn is farther from the exact one.
  [[nodiscard]] double error_bound() const { return error_bound_; }
  // C_k of the tile's poses: row r from sums()[r * stride()].
  void correlate(int tile);
  [[nodiscard]] const float* sums() const { return sums_.data(); }
  [[nodiscard]] std::size_t stride() const { return static_cast<std::size_t>(spectra_.tiles().fft_cols); }

 private:
  const MapSpectra& spectra_;
  Plane drawn_;  // all 0 between headings
  Spectrum robot_;
  Spectrum product_;
  Plane sums_;
  double error_bound_ = 0.0;
};

}  // namespace landfall::internal
