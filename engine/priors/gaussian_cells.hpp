// The cells that a Gaussian supports at one heading, found row by row.
#pragma once

#include "engine/priors/block_mask.hpp"
#include "engine/priors/gaussian_density.hpp"
#include "engine/priors/lattice.hpp"

namespace landfall::internal {

// Along a row the density is the exponential of a parabola: a row costs its two ends, a cell then two
// multiplications. A wide Gaussian holds most of the map, at every heading.
class GaussianCells {
 public:
  // The support is where density.log() is at least `least_log`; looked for in `box` alone.
  GaussianCells(const GaussianDensity& density, const Lattice& lattice, const BlockMask& free,
                const CellRange& box, double least_log)
      : density_(density), lattice_(lattice), free_(free), box_(box), least_log_(least_log) {}

  // Inserts the support's free cells at a heading. The sum of the density over them.
  double insert(double theta_map_rad, BlockMask& mask);
  // The support held the centre of a cell, free or not, at a heading so far.
  [[nodiscard]] bool any() const { return any_; }

 private:
  struct Span {
    int first;
    int last;
  };
  [[nodiscard]] Span span_of(int row, double theta_map_rad, int nearest_col,
                             const GaussianDensity::Line& line) const;
  double insert_span(const Span& span, int row, int nearest_col, const GaussianDensity::Line& line,
                     BlockMask& mask) const;
  [[nodiscard]] Pose2 T_map_robot(int col, int row, double theta_map_rad) const;

  const GaussianDensity& density_;
  const Lattice& lattice_;
  const BlockMask& free_;
  CellRange box_;
  double least_log_;
  double cos_grid_ = std::cos(lattice_.T_map_grid.theta_rad);
  double sin_grid_ = std::sin(lattice_.T_map_grid.theta_rad);
  bool any_ = false;
};

}  // namespace landfall::internal
