#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/score_row.cpp"
#include <hwy/foreach_target.h>
// foreach_target comes before highway.h
#include <hwy/highway.h>

#include <algorithm>

#include "kernels/isa.hpp"
#include "kernels/score_row.hpp"

HWY_BEFORE_NAMESPACE();
namespace landfall::kernels {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

void AddBytes(const std::uint8_t* HWY_RESTRICT values, std::uint16_t* HWY_RESTRICT sums, std::size_t count) {
  const hn::ScalableTag<std::uint16_t> d;
  const hn::Rebind<std::uint8_t, decltype(d)> d_byte;
  const std::size_t lanes = hn::Lanes(d);
  std::size_t i = 0;
  for (; i + lanes <= count; i += lanes) {
    const auto value = hn::PromoteTo(d, hn::LoadU(d_byte, values + i));
    hn::StoreU(hn::Add(hn::LoadU(d, sums + i), value), d, sums + i);
  }
  for (; i < count; ++i) sums[i] = static_cast<std::uint16_t>(sums[i] + values[i]);
}

void ScoreRow(const std::uint8_t* field, int width, int height, int row, const std::int32_t* point_col,
              const std::int32_t* point_row, std::size_t points, std::uint16_t* partial,
              std::int32_t* scores) {
  constexpr std::size_t points_per_flush = 257;  // 257 x 255 is the last sum that 16 bits hold
  const std::size_t row_cells = static_cast<std::size_t>(width);
  for (std::size_t first = 0; first < points; first += points_per_flush) {
    std::fill_n(partial, row_cells, std::uint16_t{0});
    const std::size_t last = std::min(points, first + points_per_flush);
    for (std::size_t i = first; i < last; ++i) {
      const std::int64_t field_row = std::int64_t{row} + point_row[i];
      if (field_row < 0 || field_row >= height) continue;
      const std::int64_t begin = std::max<std::int64_t>(0, -std::int64_t{point_col[i]});
      const std::int64_t end = std::min<std::int64_t>(width, std::int64_t{width} - point_col[i]);
      if (begin >= end) continue;
      AddBytes(field + field_row * width + begin + point_col[i], partial + begin,
               static_cast<std::size_t>(end - begin));
    }
    for (std::size_t c = 0; c < row_cells; ++c) scores[c] += partial[c];
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace landfall::kernels
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace landfall::kernels {

namespace scalar {
void score_row(const std::uint8_t* field, int width, int height, int row, const std::int32_t* point_col,
               const std::int32_t* point_row, std::size_t points, std::uint16_t* /*partial*/,
               std::int32_t* scores) {
  for (std::int64_t c = 0; c < width; ++c) {
    for (std::size_t i = 0; i < points; ++i) {
      const std::int64_t x = c + point_col[i];
      const std::int64_t y = std::int64_t{row} + point_row[i];
      if (x >= 0 && x < width && y >= 0 && y < height) scores[c] += field[y * width + x];
    }
  }
}
}  // namespace scalar

HWY_EXPORT(ScoreRow);

void score_row(const std::uint8_t* field, int width, int height, int row, const std::int32_t* point_col,
               const std::int32_t* point_row, std::size_t points, std::uint16_t* partial,
               std::int32_t* scores) {
  if (scalar_selected()) {
    scalar::score_row(field, width, height, row, point_col, point_row, points, partial, scores);
  } else {
    HWY_DYNAMIC_DISPATCH(ScoreRow)
    (field, width, height, row, point_col, point_row, points, partial, scores);
  }
}

}  // namespace landfall::kernels
#endif
