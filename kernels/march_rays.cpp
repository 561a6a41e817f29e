#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/march_rays.cpp"
#include <hwy/foreach_target.h>
// foreach_target comes before highway.h
#include <hwy/highway.h>

#include <algorithm>
#include <cmath>

#include "kernels/isa.hpp"
#include "kernels/march_rays.hpp"
#include "kernels/rays_under_way.hpp"

HWY_BEFORE_NAMESPACE();
namespace landfall::kernels {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using FloatTag = hn::CappedTag<float, march_multiple>;
using IntTag = hn::Rebind<std::int32_t, FloatTag>;
using WordTag = hn::Rebind<std::uint32_t, FloatTag>;
using Ints = hn::Vec<IntTag>;

HWY_INLINE Ints SideAt(const FreeSquares& squares, Ints index) {
  const IntTag d_int;
  const WordTag d_word;
  const auto words = hn::GatherIndex(d_word, squares.sides, hn::ShiftRight<2>(index));
  const auto bits = hn::ShiftLeft<3>(hn::And(index, hn::Set(d_int, 3)));
  const auto low = hn::Shr(words, hn::BitCast(d_word, bits));
  return hn::BitCast(d_int, hn::And(low, hn::Set(d_word, 255)));
}

HWY_INLINE void StartAxis(const float* from, const float* direction, std::int32_t index_step, float* start,
                          float* slope, float* per_cell, std::int32_t* step) {
  const FloatTag d;
  const IntTag d_int;
  const auto one = hn::Set(d, 1.0f);
  const auto signed_slope = hn::LoadU(d, direction);
  const auto down = hn::Lt(signed_slope, hn::Zero(d));
  const auto at = hn::LoadU(d, from);
  hn::Store(hn::IfThenElse(down, hn::Sub(one, at), at), d, start);
  hn::Store(hn::Abs(signed_slope), d, slope);
  hn::Store(hn::Min(hn::Div(one, hn::Abs(signed_slope)), hn::Set(d, most_per_cell)), d, per_cell);
  hn::Store(
      hn::IfThenElse(hn::RebindMask(d_int, down), hn::Set(d_int, -index_step), hn::Set(d_int, index_step)),
      d_int, step);
}

HWY_INLINE void StartPacket(const FreeSquares& squares, const Marches& marches, std::size_t ray,
                            RaysUnderWay& under_way, std::size_t at) {
  const FloatTag d;
  const IntTag d_int;
  const std::int32_t cells = squares.width_cells * squares.height_cells;
  StartAxis(marches.x + ray, marches.dx + ray, 1, under_way.x + at, under_way.dx + at, under_way.per_col + at,
            under_way.col_step + at);
  StartAxis(marches.y + ray, marches.dy + ray, squares.width_cells, under_way.y + at, under_way.dy + at,
            under_way.per_row + at, under_way.row_step + at);
  const auto grid_if_down = [&](const float* direction, std::int32_t grids) HWY_ATTR {
    const auto down = hn::RebindMask(d_int, hn::Lt(hn::LoadU(d, direction), hn::Zero(d)));
    return hn::IfThenElseZero(down, hn::Set(d_int, grids * cells));
  };
  const auto grid = hn::Add(grid_if_down(marches.dx + ray, 1), grid_if_down(marches.dy + ray, 2));
  hn::Store(hn::Add(hn::LoadU(d_int, marches.start_cell + ray), grid), d_int, under_way.start + at);
  hn::Store(hn::LoadU(d, marches.range_max + ray), d, under_way.range_max + at);
  hn::Store(hn::Zero(d), d, under_way.length + at);
  hn::Store(hn::Zero(d_int), d_int, under_way.col + at);
  hn::Store(hn::Zero(d_int), d_int, under_way.row + at);
}

// Takes every ray of a packet out of its square; false, and the ranges written, where all have ended.
HWY_INLINE bool AdvancePacket(const FreeSquares& squares, RaysUnderWay& under_way, std::size_t at,
                              float* range) {
  const FloatTag d;
  const IntTag d_int;
  const auto col = hn::Load(d_int, under_way.col + at);
  const auto row = hn::Load(d_int, under_way.row + at);
  const auto length = hn::Load(d, under_way.length + at);
  const auto index = hn::Add(hn::Load(d_int, under_way.start + at),
                             hn::Add(hn::Mul(col, hn::Load(d_int, under_way.col_step + at)),
                                     hn::Mul(row, hn::Load(d_int, under_way.row_step + at))));
  const Ints side = SideAt(squares, index);
  const auto in_range = hn::Le(length, hn::Load(d, under_way.range_max + at));
  const auto obstacle = hn::Eq(side, hn::Zero(d_int));
  const auto ended = hn::Or(obstacle, hn::Eq(side, hn::Set(d_int, FreeSquares::beyond_grid)));
  const auto goes_on = hn::AndNot(hn::RebindMask(d, ended), in_range);
  if (hn::AllFalse(d, goes_on)) {
    const auto hit = hn::And(in_range, hn::RebindMask(d, obstacle));
    hn::StoreU(hn::IfThenElse(hit, length, hn::Set(d, no_echo)), d, range);
    return false;
  }
  const auto x = hn::Load(d, under_way.x + at);
  const auto y = hn::Load(d, under_way.y + at);
  const auto past_col = hn::Add(col, side);
  const auto past_row = hn::Add(row, side);
  const auto to_col = hn::Mul(hn::Sub(hn::ConvertTo(d, past_col), x), hn::Load(d, under_way.per_col + at));
  const auto to_row = hn::Mul(hn::Sub(hn::ConvertTo(d, past_row), y), hn::Load(d, under_way.per_row + at));
  const auto leaves_in_x = hn::Lt(to_col, to_row);
  const auto leaves = hn::IfThenElse(leaves_in_x, to_col, to_row);
  // The other coordinate stays within the square, whatever the rounding.
  const auto along = [&](Ints from, Ints past, auto start, const float* slope) HWY_ATTR {
    const auto there = hn::ConvertTo(d_int, hn::Add(start, hn::Mul(leaves, hn::Load(d, slope))));
    return hn::Max(from, hn::Min(there, hn::Sub(past, hn::Set(d_int, 1))));
  };
  const auto in_x = hn::RebindMask(d_int, leaves_in_x);
  const auto next_col = hn::IfThenElse(in_x, past_col, along(col, past_col, x, under_way.dx + at));
  const auto next_row = hn::IfThenElse(in_x, along(row, past_row, y, under_way.dy + at), past_row);
  const auto moves = hn::RebindMask(d_int, goes_on);
  hn::Store(hn::IfThenElse(moves, next_col, col), d_int, under_way.col + at);
  hn::Store(hn::IfThenElse(moves, next_row, row), d_int, under_way.row + at);
  hn::Store(hn::IfThenElse(goes_on, leaves, length), d, under_way.length + at);
  return true;
}

void MarchRays(const FreeSquares& squares, const Marches& marches, std::size_t rays, float* range) {
  const std::size_t lanes = hn::Lanes(FloatTag());
  RaysUnderWay under_way;
  std::uint16_t packets[rays_under_way];
  for (std::size_t first = 0; first < rays; first += rays_under_way) {
    const std::size_t count = std::min(rays_under_way, rays - first);
    std::size_t left = 0;
    for (std::size_t at = 0; at < count; at += lanes) {
      StartPacket(squares, marches, first + at, under_way, at);
      packets[left++] = static_cast<std::uint16_t>(at);
    }
    while (left > 0) {
      std::size_t kept = 0;
      for (std::size_t p = 0; p < left; ++p) {
        const std::uint16_t at = packets[p];
        packets[kept] = at;
        kept += AdvancePacket(squares, under_way, at, range + first + at) ? 1 : 0;
      }
      left = kept;
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace landfall::kernels
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace landfall::kernels {

namespace scalar {
namespace {

// One coordinate of a ray, mirrored so that it goes up.
struct Axis {
  Axis(float from, float direction, std::int32_t index_step)
      : start(direction < 0.0f ? 1.0f - from : from),
        slope(std::abs(direction)),
        per_cell(std::min(1.0f / slope, most_per_cell)),
        step(direction < 0.0f ? -index_step : index_step) {}

  [[nodiscard]] float length_to(std::int32_t past) const {
    return (static_cast<float>(past) - start) * per_cell;
  }
  // The cell at a length, within a square from the present one.
  [[nodiscard]] std::int32_t cell_at(float length, std::int32_t past) const {
    return std::max(cell, std::min(static_cast<std::int32_t>(start + length * slope), past - 1));
  }

  float start, slope, per_cell;
  std::int32_t step;
  std::int32_t cell = 0;
};

float march_ray(const FreeSquares& squares, Axis x, Axis y, std::int32_t start, float range_max) {
  float length = 0.0f;
  while (length <= range_max) {
    const std::int32_t index = start + x.cell * x.step + y.cell * y.step;
    const auto side = static_cast<std::int32_t>(squares.sides[index / 4] >> (8 * (index % 4)) & 255u);
    if (side == FreeSquares::obstacle) return length;
    if (side == FreeSquares::beyond_grid) return no_echo;
    const std::int32_t past_col = x.cell + side;
    const std::int32_t past_row = y.cell + side;
    const float to_col = x.length_to(past_col);
    const float to_row = y.length_to(past_row);
    length = to_col < to_row ? to_col : to_row;
    const std::int32_t col = to_col < to_row ? past_col : x.cell_at(length, past_col);
    y.cell = to_col < to_row ? y.cell_at(length, past_row) : past_row;
    x.cell = col;
  }
  return no_echo;
}

}  // namespace

void march_rays(const FreeSquares& squares, const Marches& marches, std::size_t rays, float* range) {
  const std::int32_t cells = squares.width_cells * squares.height_cells;
  for (std::size_t i = 0; i < rays; ++i) {
    const std::int32_t grid = (marches.dx[i] < 0.0f ? cells : 0) + (marches.dy[i] < 0.0f ? 2 * cells : 0);
    range[i] = march_ray(squares, Axis(marches.x[i], marches.dx[i], 1),
                         Axis(marches.y[i], marches.dy[i], squares.width_cells), marches.start_cell[i] + grid,
                         marches.range_max[i]);
  }
}
}  // namespace scalar

HWY_EXPORT(MarchRays);

void march_rays(const FreeSquares& squares, const Marches& marches, std::size_t rays, float* range) {
  if (scalar_selected()) {
    scalar::march_rays(squares, marches, rays, range);
  } else {
    HWY_DYNAMIC_DISPATCH(MarchRays)(squares, marches, rays, range);
  }
}

}  // namespace landfall::kernels
#endif
