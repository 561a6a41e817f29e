#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/score_cells.cpp"
#include <hwy/foreach_target.h>
// foreach_target comes before highway.h
#include <hwy/highway.h>

#include <algorithm>

#include "kernels/isa.hpp"
#include "kernels/score_cells.hpp"

HWY_BEFORE_NAMESPACE();
namespace landfall::kernels {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Bytes = hn::CappedTag<std::int8_t, score_columns>;
using Words = hn::ScalableTag<std::int32_t>;

// sums[c] += weight * values[c] over one vector of bytes.
void AddWeighted(const std::int8_t* HWY_RESTRICT values, std::int32_t weight, std::size_t cols,
                 std::int32_t* HWY_RESTRICT sums) {
  const Words d;
  const hn::Rebind<std::int8_t, Words> d_byte;
  const auto factor = hn::Set(d, weight);
  for (std::size_t c = 0; c < cols; c += hn::Lanes(d)) {
    const auto value = hn::PromoteTo(d, hn::LoadU(d_byte, values + c));
    hn::StoreU(hn::Add(hn::LoadU(d, sums + c), hn::Mul(value, factor)), d, sums + c);
  }
}

// Cells of one weight are added up as bytes and weighted once.
void ScoreColumns(const std::int8_t* HWY_RESTRICT global, const CellRuns& local, std::size_t cols,
                  std::int32_t* HWY_RESTRICT scores) {
  constexpr std::int32_t cells_per_flush = 127;  // the last sum that a byte holds
  const Bytes d;
  HWY_ALIGN std::int8_t partial[score_columns];
  std::int32_t i = 0;
  for (std::size_t r = 0; r < local.runs; ++r) {
    while (i < local.run_end[r]) {
      const std::int32_t last = std::min(local.run_end[r], i + cells_per_flush);
      auto sum = hn::Zero(d);
      for (; i < last; ++i) sum = hn::Add(sum, hn::LoadU(d, global + local.offset[i]));
      hn::Store(sum, d, partial);
      AddWeighted(partial, local.run_weight[r], cols, scores);
    }
  }
}

void ScoreCells(const std::int8_t* HWY_RESTRICT global, const CellRuns& local, std::size_t cols,
                std::int32_t* HWY_RESTRICT scores) {
  const std::size_t lanes = hn::Lanes(Bytes());
  std::fill_n(scores, whole_columns(cols), 0);
  for (std::size_t c = 0; c < cols; c += lanes)
    ScoreColumns(global + c, local, std::min(lanes, cols - c), scores + c);
}

}  // namespace HWY_NAMESPACE
}  // namespace landfall::kernels
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace landfall::kernels {

namespace scalar {
void score_cells(const std::int8_t* global, const CellRuns& local, std::size_t cols, std::int32_t* scores) {
  for (std::size_t c = 0; c < cols; ++c) {
    scores[c] = 0;
    std::int32_t i = 0;
    for (std::size_t r = 0; r < local.runs; ++r)
      for (; i < local.run_end[r]; ++i)
        scores[c] += local.run_weight[r] * global[static_cast<std::ptrdiff_t>(c) + local.offset[i]];
  }
}
}  // namespace scalar

HWY_EXPORT(ScoreCells);

void score_cells(const std::int8_t* global, const CellRuns& local, std::size_t cols, std::int32_t* scores) {
  if (scalar_selected()) {
    scalar::score_cells(global, local, cols, scores);
  } else {
    HWY_DYNAMIC_DISPATCH(ScoreCells)(global, local, cols, scores);
  }
}

}  // namespace landfall::kernels
#endif
