#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/end_points.cpp"
#include <hwy/foreach_target.h>
// foreach_target comes before highway.h
#include <hwy/highway.h>

#include <cmath>

#include "kernels/end_points.hpp"
#include "kernels/isa.hpp"

HWY_BEFORE_NAMESPACE();
namespace landfall::kernels {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

void EndPointCells(const double* x_cells, const double* y_cells, std::size_t points, double cos_heading,
                   double sin_heading, std::int32_t* col, std::int32_t* row) {
  const hn::ScalableTag<double> d;
  const hn::Rebind<std::int32_t, decltype(d)> d_int;
  const std::size_t lanes = hn::Lanes(d);
  const auto cos_v = hn::Set(d, cos_heading);
  const auto sin_v = hn::Set(d, sin_heading);
  const auto half = hn::Set(d, 0.5);
  std::size_t i = 0;
  for (; i + lanes <= points; i += lanes) {
    const auto x = hn::LoadU(d, x_cells + i);
    const auto y = hn::LoadU(d, y_cells + i);
    const auto x_map = hn::Sub(hn::Mul(cos_v, x), hn::Mul(sin_v, y));
    const auto y_map = hn::Add(hn::Mul(sin_v, x), hn::Mul(cos_v, y));
    hn::StoreU(hn::DemoteTo(d_int, hn::Floor(hn::Add(half, x_map))), d_int, col + i);
    hn::StoreU(hn::DemoteTo(d_int, hn::Floor(hn::Add(half, y_map))), d_int, row + i);
  }
  scalar::end_point_cells(x_cells + i, y_cells + i, points - i, cos_heading, sin_heading, col + i, row + i);
}

}  // namespace HWY_NAMESPACE
}  // namespace landfall::kernels
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace landfall::kernels {

namespace scalar {
void end_point_cells(const double* x_cells, const double* y_cells, std::size_t points, double cos_heading,
                     double sin_heading, std::int32_t* col, std::int32_t* row) {
  for (std::size_t i = 0; i < points; ++i) {
    const double x_map = cos_heading * x_cells[i] - sin_heading * y_cells[i];
    const double y_map = sin_heading * x_cells[i] + cos_heading * y_cells[i];
    col[i] = static_cast<std::int32_t>(std::floor(0.5 + x_map));
    row[i] = static_cast<std::int32_t>(std::floor(0.5 + y_map));
  }
}
}  // namespace scalar

HWY_EXPORT(EndPointCells);

void end_point_cells(const double* x_cells, const double* y_cells, std::size_t points, double cos_heading,
                     double sin_heading, std::int32_t* col, std::int32_t* row) {
  if (scalar_selected()) {
    scalar::end_point_cells(x_cells, y_cells, points, cos_heading, sin_heading, col, row);
  } else {
    HWY_DYNAMIC_DISPATCH(EndPointCells)(x_cells, y_cells, points, cos_heading, sin_heading, col, row);
  }
}

}  // namespace landfall::kernels
#endif
