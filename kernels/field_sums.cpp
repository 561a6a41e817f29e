#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/field_sums.cpp"
#include <hwy/foreach_target.h>
// foreach_target comes before highway.h
#include <hwy/highway.h>

#include <algorithm>

#include "kernels/field_sum_lanes.hpp"
#include "kernels/isa.hpp"

HWY_BEFORE_NAMESPACE();
namespace landfall::kernels {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

#if HWY_TARGET == HWY_SCALAR
FieldSums SumLack(const FieldView& field, const FieldPose& pose, const double* x_cells, const double* y_cells,
                  std::size_t points) {
  return scalar::sum_lack(field, pose, x_cells, y_cells, points);
}
FieldSums SumRoot(const FieldView& field, const FieldPose& pose, const double* x_cells, const double* y_cells,
                  std::size_t points) {
  return scalar::sum_root(field, pose, x_cells, y_cells, points);
}
#else

using Tag = hn::CappedTag<double, sum_lanes>;
using Vec = hn::Vec<Tag>;
using CellTag = hn::Rebind<std::int32_t, Tag>;

struct Sample {
  Vec value, d_col, d_row;
};

// The four cells around a point are two loads of four bytes: two above its lower left, and two more before
// the upper pair, so that nothing is read past the field.
HWY_INLINE Sample SampleField(const FieldView& field, Vec x_cells, Vec y_cells) {
  const Tag d;
  const CellTag d_cell;
  const auto zero = hn::Zero(d);
  const auto half = hn::Set(d, 0.5);
  const auto scale = hn::Set(d, 1.0 / 255.0);
  const auto x = hn::Sub(x_cells, half);
  const auto y = hn::Sub(y_cells, half);
  const auto inside = hn::And(
      hn::And(hn::Ge(x, zero), hn::Ge(y, zero)),
      hn::And(hn::Lt(x, hn::Set(d, field.width_cells - 1)), hn::Lt(y, hn::Set(d, field.height_cells - 1))));
  const auto safe_x = hn::IfThenElseZero(inside, x);
  const auto safe_y = hn::IfThenElseZero(inside, y);
  const auto col = hn::DemoteTo(d_cell, safe_x);
  const auto row = hn::DemoteTo(d_cell, safe_y);
  const auto fx = hn::Sub(safe_x, hn::PromoteTo(d, col));
  const auto fy = hn::Sub(safe_y, hn::PromoteTo(d, row));
  const auto at = hn::Add(hn::Mul(row, hn::Set(d_cell, field.width_cells)), col);
  const auto* bytes = reinterpret_cast<const std::int32_t*>(field.values);
  const auto low_pair = hn::GatherOffset(d_cell, bytes, at);
  const auto high_pair = hn::ShiftRight<16>(
      hn::GatherOffset(d_cell, bytes, hn::Add(at, hn::Set(d_cell, field.width_cells - 2))));
  const auto byte = hn::Set(d_cell, 0xFF);
  const auto value_of = [&](auto cells)
                            HWY_ATTR { return hn::Mul(scale, hn::PromoteTo(d, hn::And(byte, cells))); };
  const auto v00 = value_of(low_pair);
  const auto v01 = value_of(hn::ShiftRight<8>(low_pair));
  const auto v10 = value_of(high_pair);
  const auto v11 = value_of(hn::ShiftRight<8>(high_pair));
  const auto low = hn::Add(v00, hn::Mul(fx, hn::Sub(v01, v00)));
  const auto high = hn::Add(v10, hn::Mul(fx, hn::Sub(v11, v10)));
  const auto d_low = hn::Mul(hn::Sub(hn::Set(d, 1.0), fy), hn::Sub(v01, v00));
  return {.value = hn::IfThenElseZero(inside, hn::Add(low, hn::Mul(fy, hn::Sub(high, low)))),
          .d_col = hn::IfThenElseZero(inside, hn::Add(d_low, hn::Mul(fy, hn::Sub(v11, v10)))),
          .d_row = hn::IfThenElseZero(inside, hn::Sub(high, low))};
}

// Points first, first + sum_lanes, ... of each of a vector's lanes, whose sums stay in registers.
template <bool Root>
HWY_INLINE void AddLanes(const FieldView& field, const FieldPose& pose, const double* HWY_RESTRICT x_cells,
                         const double* HWY_RESTRICT y_cells, std::size_t first, std::size_t points,
                         FieldSumLanes& sums) {
  const Tag d;
  const auto zero = hn::Zero(d);
  const auto one = hn::Set(d, 1.0);
  const auto c = hn::Set(d, pose.cos_theta);
  const auto s = hn::Set(d, pose.sin_theta);
  const auto x0 = hn::Set(d, pose.x_cells);
  const auto y0 = hn::Set(d, pose.y_cells);
  auto cost = zero, field_sum = zero, h_xx = zero, h_xy = zero, h_xt = zero, h_yy = zero, h_yt = zero;
  auto h_tt = zero, g_x = zero, g_y = zero, g_t = zero;
  for (std::size_t i = first; i < points; i += sum_lanes) {
    const auto x_scan = hn::LoadU(d, x_cells + i);
    const auto y_scan = hn::LoadU(d, y_cells + i);
    const auto x = hn::Sub(hn::Mul(c, x_scan), hn::Mul(s, y_scan));
    const auto y = hn::Add(hn::Mul(s, x_scan), hn::Mul(c, y_scan));
    const Sample at = SampleField(field, hn::Add(x0, x), hn::Add(y0, y));
    const auto lack = hn::Sub(one, at.value);
    const auto turn = hn::Sub(hn::Mul(at.d_row, x), hn::Mul(at.d_col, y));
    const auto weight = Root ? hn::Div(hn::Set(d, 0.25), hn::Max(hn::Set(d, least_lack), lack)) : one;
    const auto pull = Root ? hn::Set(d, 0.5) : lack;
    const auto w_x = hn::Mul(weight, at.d_col);
    const auto w_y = hn::Mul(weight, at.d_row);
    cost = hn::Add(cost, Root ? lack : hn::Mul(lack, lack));
    field_sum = hn::Add(field_sum, at.value);
    h_xx = hn::Add(h_xx, hn::Mul(w_x, at.d_col));
    h_xy = hn::Add(h_xy, hn::Mul(w_x, at.d_row));
    h_xt = hn::Add(h_xt, hn::Mul(w_x, turn));
    h_yy = hn::Add(h_yy, hn::Mul(w_y, at.d_row));
    h_yt = hn::Add(h_yt, hn::Mul(w_y, turn));
    h_tt = hn::Add(h_tt, hn::Mul(hn::Mul(weight, turn), turn));
    g_x = hn::Add(g_x, hn::Mul(pull, at.d_col));
    g_y = hn::Add(g_y, hn::Mul(pull, at.d_row));
    g_t = hn::Add(g_t, hn::Mul(pull, turn));
  }
  hn::Store(cost, d, sums.cost + first);
  hn::Store(field_sum, d, sums.field + first);
  hn::Store(h_xx, d, sums.h_xx + first);
  hn::Store(h_xy, d, sums.h_xy + first);
  hn::Store(h_xt, d, sums.h_xt + first);
  hn::Store(h_yy, d, sums.h_yy + first);
  hn::Store(h_yt, d, sums.h_yt + first);
  hn::Store(h_tt, d, sums.h_tt + first);
  hn::Store(g_x, d, sums.g_x + first);
  hn::Store(g_y, d, sums.g_y + first);
  hn::Store(g_t, d, sums.g_t + first);
}

template <bool Root>
HWY_INLINE FieldSums Sum(const FieldView& field, const FieldPose& pose, const double* x_cells,
                         const double* y_cells, std::size_t points) {
  FieldSumLanes sums;
  const bool has_square = field.width_cells >= 2 && field.height_cells >= 2;
  const std::size_t whole = has_square ? points / sum_lanes * sum_lanes : 0;
  for (std::size_t lane = 0; whole > 0 && lane < sum_lanes; lane += hn::Lanes(Tag()))
    AddLanes<Root>(field, pose, x_cells, y_cells, lane, whole, sums);
  const auto add_rest = Root ? scalar::add_root : scalar::add_lack;
  add_rest(field, pose, x_cells, y_cells, whole, points, sums);
  return sums.total();
}

FieldSums SumLack(const FieldView& field, const FieldPose& pose, const double* x_cells, const double* y_cells,
                  std::size_t points) {
  return Sum<false>(field, pose, x_cells, y_cells, points);
}
FieldSums SumRoot(const FieldView& field, const FieldPose& pose, const double* x_cells, const double* y_cells,
                  std::size_t points) {
  return Sum<true>(field, pose, x_cells, y_cells, points);
}

#endif
}  // namespace HWY_NAMESPACE
}  // namespace landfall::kernels
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace landfall::kernels {

namespace scalar {
namespace {

struct Sample {
  double value = 0.0;
  double d_col = 0.0;
  double d_row = 0.0;
};

Sample sample(const FieldView& field, double x_cells, double y_cells) {
  const double x = x_cells - 0.5;
  const double y = y_cells - 0.5;
  if (!(x >= 0.0 && y >= 0.0 && x < field.width_cells - 1 && y < field.height_cells - 1)) return {};
  const auto col = static_cast<int>(x);
  const auto row = static_cast<int>(y);
  const double fx = x - col;
  const double fy = y - row;
  const std::uint8_t* at = field.values + static_cast<std::ptrdiff_t>(row) * field.width_cells + col;
  constexpr double scale = 1.0 / 255.0;
  const double v00 = at[0] * scale;
  const double v01 = at[1] * scale;
  const double v10 = at[field.width_cells] * scale;
  const double v11 = at[field.width_cells + 1] * scale;
  const double low = v00 + fx * (v01 - v00);
  const double high = v10 + fx * (v11 - v10);
  return {low + fy * (high - low), (1.0 - fy) * (v01 - v00) + fy * (v11 - v10), high - low};
}

template <bool Root>
void add(const FieldView& field, const FieldPose& pose, const double* x_cells, const double* y_cells,
         std::size_t first, std::size_t last, FieldSumLanes& sums) {
  for (std::size_t i = first; i < last; ++i) {
    const double x = pose.cos_theta * x_cells[i] - pose.sin_theta * y_cells[i];
    const double y = pose.sin_theta * x_cells[i] + pose.cos_theta * y_cells[i];
    const Sample at = sample(field, pose.x_cells + x, pose.y_cells + y);
    const double lack = 1.0 - at.value;
    const double turn = at.d_row * x - at.d_col * y;
    const double weight = Root ? 0.25 / std::max(least_lack, lack) : 1.0;
    const double pull = Root ? 0.5 : lack;
    const std::size_t lane = i % sum_lanes;
    sums.cost[lane] += Root ? lack : lack * lack;
    sums.field[lane] += at.value;
    sums.h_xx[lane] += weight * at.d_col * at.d_col;
    sums.h_xy[lane] += weight * at.d_col * at.d_row;
    sums.h_xt[lane] += weight * at.d_col * turn;
    sums.h_yy[lane] += weight * at.d_row * at.d_row;
    sums.h_yt[lane] += weight * at.d_row * turn;
    sums.h_tt[lane] += weight * turn * turn;
    sums.g_x[lane] += pull * at.d_col;
    sums.g_y[lane] += pull * at.d_row;
    sums.g_t[lane] += pull * turn;
  }
}

}  // namespace

void add_lack(const FieldView& field, const FieldPose& pose, const double* x_cells, const double* y_cells,
              std::size_t first, std::size_t last, FieldSumLanes& sums) {
  add<false>(field, pose, x_cells, y_cells, first, last, sums);
}
void add_root(const FieldView& field, const FieldPose& pose, const double* x_cells, const double* y_cells,
              std::size_t first, std::size_t last, FieldSumLanes& sums) {
  add<true>(field, pose, x_cells, y_cells, first, last, sums);
}

FieldSums sum_lack(const FieldView& field, const FieldPose& pose, const double* x_cells,
                   const double* y_cells, std::size_t points) {
  FieldSumLanes sums;
  add_lack(field, pose, x_cells, y_cells, 0, points, sums);
  return sums.total();
}
FieldSums sum_root(const FieldView& field, const FieldPose& pose, const double* x_cells,
                   const double* y_cells, std::size_t points) {
  FieldSumLanes sums;
  add_root(field, pose, x_cells, y_cells, 0, points, sums);
  return sums.total();
}

}  // namespace scalar

HWY_EXPORT(SumLack);
HWY_EXPORT(SumRoot);

FieldSums sum_lack(const FieldView& field, const FieldPose& pose, const double* x_cells,
                   const double* y_cells, std::size_t points) {
  const auto run = scalar_selected() ? scalar::sum_lack : HWY_DYNAMIC_DISPATCH(SumLack);
  return run(field, pose, x_cells, y_cells, points);
}
FieldSums sum_root(const FieldView& field, const FieldPose& pose, const double* x_cells,
                   const double* y_cells, std::size_t points) {
  const auto run = scalar_selected() ? scalar::sum_root : HWY_DYNAMIC_DISPATCH(SumRoot);
  return run(field, pose, x_cells, y_cells, points);
}

}  // namespace landfall::kernels
#endif
