#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/count_fits.cpp"
#include <hwy/foreach_target.h>
// foreach_target comes before highway.h
#include <hwy/highway.h>

#include <algorithm>

#include "kernels/count_fits.hpp"
#include "kernels/isa.hpp"

HWY_BEFORE_NAMESPACE();
namespace landfall::kernels {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

std::int32_t CountFits(const CellBits& cells, const PointPose& pose, const float* x_cells,
                       const float* y_cells, std::size_t points) {
  const hn::ScalableTag<float> d;
  const hn::RebindToSigned<decltype(d)> d_int;
  const std::size_t lanes = hn::Lanes(d);
  const auto zero = hn::Zero(d);
  const auto last_col = hn::Set(d, static_cast<float>(cells.width_cells - 1));
  const auto last_row = hn::Set(d, static_cast<float>(cells.height_cells - 1));
  const auto c = hn::Set(d, pose.cos_theta);
  const auto s = hn::Set(d, pose.sin_theta);
  const auto x0 = hn::Set(d, pose.x_cells);
  const auto y0 = hn::Set(d, pose.y_cells);
  const auto row_words = hn::Set(d_int, cells.row_words);
  const auto one = hn::Set(d_int, 1);
  const auto* words = reinterpret_cast<const std::int32_t*>(cells.words);
  auto fits = hn::Zero(d_int);
  std::size_t i = 0;
  for (; i + lanes <= points; i += lanes) {
    const auto x = hn::LoadU(d, x_cells + i);
    const auto y = hn::LoadU(d, y_cells + i);
    const auto x_grid = hn::Add(x0, hn::Sub(hn::Mul(c, x), hn::Mul(s, y)));
    const auto y_grid = hn::Add(y0, hn::Add(hn::Mul(s, x), hn::Mul(c, y)));
    const auto col = hn::ConvertTo(d_int, hn::Min(hn::Max(x_grid, zero), last_col));
    const auto row = hn::ConvertTo(d_int, hn::Min(hn::Max(y_grid, zero), last_row));
    const auto at = hn::Add(hn::Mul(row, row_words), hn::ShiftRight<5>(col));
    const auto bit = hn::Shl(one, hn::And(col, hn::Set(d_int, 31)));
    const auto hit = hn::Ne(hn::And(hn::GatherIndex(d_int, words, at), bit), hn::Zero(d_int));
    fits = hn::Add(fits, hn::IfThenElseZero(hit, one));
  }
  return hn::GetLane(hn::SumOfLanes(d_int, fits)) +
         scalar::count_fits(cells, pose, x_cells + i, y_cells + i, points - i);
}

}  // namespace HWY_NAMESPACE
}  // namespace landfall::kernels
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace landfall::kernels {

namespace scalar {
std::int32_t count_fits(const CellBits& cells, const PointPose& pose, const float* x_cells,
                        const float* y_cells, std::size_t points) {
  const auto last_col = static_cast<float>(cells.width_cells - 1);
  const auto last_row = static_cast<float>(cells.height_cells - 1);
  std::int32_t fits = 0;
  for (std::size_t i = 0; i < points; ++i) {
    const float x = pose.x_cells + (pose.cos_theta * x_cells[i] - pose.sin_theta * y_cells[i]);
    const float y = pose.y_cells + (pose.sin_theta * x_cells[i] + pose.cos_theta * y_cells[i]);
    const auto col = static_cast<std::int32_t>(std::min(std::max(x, 0.0f), last_col));
    const auto row = static_cast<std::int32_t>(std::min(std::max(y, 0.0f), last_row));
    const std::uint32_t word = cells.words[static_cast<std::ptrdiff_t>(row) * cells.row_words + col / 32];
    fits += static_cast<std::int32_t>((word >> (col % 32)) & 1U);
  }
  return fits;
}
}  // namespace scalar

HWY_EXPORT(CountFits);

std::int32_t count_fits(const CellBits& cells, const PointPose& pose, const float* x_cells,
                        const float* y_cells, std::size_t points) {
  if (scalar_selected()) return scalar::count_fits(cells, pose, x_cells, y_cells, points);
  return HWY_DYNAMIC_DISPATCH(CountFits)(cells, pose, x_cells, y_cells, points);
}

}  // namespace landfall::kernels
#endif
