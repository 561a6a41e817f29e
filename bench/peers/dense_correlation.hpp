// The likelihood field correlated with a scan's end points at one heading, for all poses of the map: by
// libraries made for it.
#pragma once

#include <memory>
#include <span>

#include "engine/scans/end_points.hpp"
#include "landfall/prepared_map.hpp"

namespace landfall::bench {

class DenseCorrelation {
 public:
  DenseCorrelation() = default;
  virtual ~DenseCorrelation() = default;
  DenseCorrelation(const DenseCorrelation&) = delete;
  DenseCorrelation& operator=(const DenseCorrelation&) = delete;

  // sums[row * width_cells + col]: of the field over the end points as seen from cell (col, row).
  virtual void correlate(const internal::HeadingCells& points, std::span<float> sums) = 0;
};

// For scans whose end points are less than reach_cells away from the robot.

// The end points drawn as a template, which matchTemplate slides over the field. Bytes, one thread.
std::unique_ptr<DenseCorrelation> opencv_correlation(const PreparedMap& map, int reach_cells);
// A transform of the drawn end points, a product with the field's spectrum, a transform back. Single
// precision, one thread, plans measured.
std::unique_ptr<DenseCorrelation> fftw_correlation(const PreparedMap& map, int reach_cells);

}  // namespace landfall::bench
