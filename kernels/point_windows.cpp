#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/point_windows.cpp"
#include <hwy/foreach_target.h>
// foreach_target comes before highway.h
#include <hwy/highway.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "kernels/isa.hpp"
#include "kernels/point_windows.hpp"

HWY_BEFORE_NAMESPACE();
namespace landfall::kernels {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

void PointWindows(const double* x_cells, const double* y_cells, std::size_t points, const Turn& turn,
                  const WindowGrid& grid, std::int32_t* col_half, std::int32_t* row_half,
                  std::int32_t* size_halves) {
  const hn::ScalableTag<double> d;
  const hn::Rebind<std::int32_t, decltype(d)> d_int;
  const std::size_t lanes = hn::Lanes(d);
  const auto c = hn::Set(d, turn.cos_center);
  const auto s = hn::Set(d, turn.sin_center);
  const auto sin_half = hn::Set(d, turn.sin_half);
  const auto cos_half = hn::Set(d, turn.cos_half);
  const auto low = hn::Set(d, 0.5 - window_rounding);
  const auto high = hn::Set(d, 0.5 + window_rounding);
  const auto width = hn::Set(d_int, grid.width_cells);
  const auto height = hn::Set(d_int, grid.height_cells);
  const auto zero = hn::Zero(d_int);
  const int half_cells = grid.block_cells / 2;
  const int shift = std::countr_zero(static_cast<unsigned>(half_cells));
  const auto past = hn::Set(d_int, grid.block_cells + half_cells - 1);
  std::size_t i = 0;
  // All cell offsets that one coordinate can have: it moves sideways by the other's share of the turn, and
  // towards 0 (beyond, for a negative cosine) by the arc's sagitta.
  const auto window = [&](auto center, auto side, auto extent, auto& first, auto& size) HWY_ATTR {
    const auto inner = hn::Mul(center, cos_half);
    const auto reach = hn::Mul(hn::Abs(side), sin_half);
    const auto least = hn::DemoteTo(d_int, hn::Floor(hn::Sub(hn::Add(low, hn::Min(center, inner)), reach)));
    const auto most = hn::DemoteTo(d_int, hn::Floor(hn::Add(hn::Add(high, hn::Max(center, inner)), reach)));
    first = hn::ShiftRightSame(least, shift);
    size = hn::ShiftRightSame(hn::Add(past, hn::Sub(most, hn::ShiftLeftSame(first, shift))), shift);
    return hn::Or(hn::Not(hn::Lt(least, extent)), hn::Not(hn::Gt(most, hn::Sub(zero, extent))));
  };
  for (; i + lanes <= points; i += lanes) {
    const auto x_scan = hn::LoadU(d, x_cells + i);
    const auto y_scan = hn::LoadU(d, y_cells + i);
    const auto x = hn::Sub(hn::Mul(c, x_scan), hn::Mul(s, y_scan));
    const auto y = hn::Add(hn::Mul(s, x_scan), hn::Mul(c, y_scan));
    auto col = zero, row = zero, wide = zero, tall = zero;
    const auto off_cols = window(x, y, width, col, wide);
    const auto off_rows = window(y, x, height, row, tall);
    hn::StoreU(col, d_int, col_half + i);
    hn::StoreU(row, d_int, row_half + i);
    hn::StoreU(hn::IfThenZeroElse(hn::Or(off_cols, off_rows), hn::Max(wide, tall)), d_int, size_halves + i);
  }
  scalar::point_windows(x_cells + i, y_cells + i, points - i, turn, grid, col_half + i, row_half + i,
                        size_halves + i);
}

}  // namespace HWY_NAMESPACE
}  // namespace landfall::kernels
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace landfall::kernels {

namespace scalar {

void point_windows(const double* x_cells, const double* y_cells, std::size_t points, const Turn& turn,
                   const WindowGrid& grid, std::int32_t* col_half, std::int32_t* row_half,
                   std::int32_t* size_halves) {
  const int half_cells = grid.block_cells / 2;
  const int shift = std::countr_zero(static_cast<unsigned>(half_cells));
  const auto window = [&](double center, double side, std::int32_t extent, std::int32_t& first,
                          std::int32_t& size) {
    const double inner = center * turn.cos_half;
    const double reach = std::abs(side) * turn.sin_half;
    const auto least =
        static_cast<std::int32_t>(std::floor((0.5 - window_rounding) + std::min(center, inner) - reach));
    const auto most =
        static_cast<std::int32_t>(std::floor((0.5 + window_rounding) + std::max(center, inner) + reach));
    first = least >> shift;
    size = (grid.block_cells + half_cells - 1 + most - (first << shift)) >> shift;
    return least >= extent || most <= -extent;
  };
  for (std::size_t i = 0; i < points; ++i) {
    const double x = turn.cos_center * x_cells[i] - turn.sin_center * y_cells[i];
    const double y = turn.sin_center * x_cells[i] + turn.cos_center * y_cells[i];
    std::int32_t wide = 0;
    std::int32_t tall = 0;
    const bool off_cols = window(x, y, grid.width_cells, col_half[i], wide);
    const bool off_rows = window(y, x, grid.height_cells, row_half[i], tall);
    size_halves[i] = off_cols || off_rows ? 0 : std::max(wide, tall);
  }
}

}  // namespace scalar

HWY_EXPORT(PointWindows);

void point_windows(const double* x_cells, const double* y_cells, std::size_t points, const Turn& turn,
                   const WindowGrid& grid, std::int32_t* col_half, std::int32_t* row_half,
                   std::int32_t* size_halves) {
  const auto run = scalar_selected() ? scalar::point_windows : HWY_DYNAMIC_DISPATCH(PointWindows);
  run(x_cells, y_cells, points, turn, grid, col_half, row_half, size_halves);
}

}  // namespace landfall::kernels
#endif
