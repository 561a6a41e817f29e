// How a scan's points lie on a field, summed up for Gauss-Newton.
#pragma once

#include <cstddef>
#include <cstdint>

namespace landfall::kernels {

// 0..255 for 0..1, row by row; less than 2^31 cells.
struct FieldView {
  const std::uint8_t* values = nullptr;
  std::int32_t width_cells = 0;
  std::int32_t height_cells = 0;
};

// In cells from the grid's corner.
struct FieldPose {
  double x_cells = 0.0;
  double y_cells = 0.0;
  double cos_theta = 1.0;
  double sin_theta = 0.0;
};

// Over the points; v: the field there, bilinear between cell centres, 0 outside of them; J: its derivative by
// x, y (cells) and the heading. With residuals 1 - v: cost = sum (1 - v)^2, h = sum J J^T, g = sum (1 - v) J.
// With residuals sqrt(1 - v): cost = sum (1 - v), h = sum J J^T / (4 max(1 - v, least_lack)), g = sum J / 2.
struct FieldSums {
  double cost = 0.0;
  double field = 0.0;  // sum v
  double h_xx = 0.0, h_xy = 0.0, h_xt = 0.0, h_yy = 0.0, h_yt = 0.0, h_tt = 0.0;
  double g_x = 0.0, g_y = 0.0, g_t = 0.0;
};
inline constexpr double least_lack = 0.02;  // the root is steep at 0

// Equal over instruction sets, bit for bit.
FieldSums sum_lack(const FieldView& field, const FieldPose& pose, const double* x_cells,
                   const double* y_cells, std::size_t points);
FieldSums sum_root(const FieldView& field, const FieldPose& pose, const double* x_cells,
                   const double* y_cells, std::size_t points);

namespace scalar {
FieldSums sum_lack(const FieldView& field, const FieldPose& pose, const double* x_cells,
                   const double* y_cells, std::size_t points);
FieldSums sum_root(const FieldView& field, const FieldPose& pose, const double* x_cells,
                   const double* y_cells, std::size_t points);
}  // namespace scalar

}  // namespace landfall::kernels
