#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/merge_windows.cpp"
#include <hwy/foreach_target.h>
// foreach_target comes before highway.h
#include <hwy/highway.h>

#include <algorithm>
#include <limits>

#include "kernels/isa.hpp"
#include "kernels/merge_windows.hpp"

HWY_BEFORE_NAMESPACE();
namespace landfall::kernels {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Tag = hn::CappedTag<std::int32_t, 16>;
using Vec = hn::Vec<Tag>;

// Writes a whole vector; later ones overwrite what was too much.
HWY_INLINE void Append(Vec values, hn::Mask<Tag> chosen, std::int32_t* HWY_RESTRICT out) {
  hn::StoreU(hn::Compress(values, chosen), Tag(), out);
}

// Where windows differ from the one before. How many; the end of the last run stands behind them.
std::size_t FindRuns(const std::int32_t* HWY_RESTRICT col, const std::int32_t* HWY_RESTRICT row,
                     const std::int32_t* HWY_RESTRICT size, std::size_t points,
                     std::int32_t* HWY_RESTRICT run_begin) {
  const Tag d;
  const std::size_t lanes = hn::Lanes(d);
  run_begin[0] = 0;
  std::size_t runs = 1;
  std::size_t i = 1;
  for (; i + lanes <= points; i += lanes) {
    const auto differs = [&](const std::int32_t* HWY_RESTRICT of)
                             HWY_ATTR { return hn::Xor(hn::LoadU(d, of + i), hn::LoadU(d, of + i - 1)); };
    const auto any = hn::Ne(hn::Or(hn::Or(differs(col), differs(row)), differs(size)), hn::Zero(d));
    Append(hn::Iota(d, static_cast<std::int32_t>(i)), any, run_begin + runs);
    runs += hn::CountTrue(d, any);
  }
  for (; i < points; ++i) {
    run_begin[runs] = static_cast<std::int32_t>(i);
    const std::int32_t differs = (col[i] ^ col[i - 1]) | (row[i] ^ row[i - 1]) | (size[i] ^ size[i - 1]);
    runs += differs != 0 ? 1 : 0;
  }
  run_begin[runs] = static_cast<std::int32_t>(points);
  return runs;
}

MergedCount MergeWindows(const std::int32_t* col_half, const std::int32_t* row_half,
                         const std::int32_t* size_halves, std::size_t points, const WindowShelf& shelf,
                         std::int32_t* run_begin, const WindowLists& lists) {
  begin_lists(points, lists);
  if (points == 0) return {};
  const Tag d;
  const auto lanes = static_cast<std::int32_t>(hn::Lanes(d));
  const auto zero = hn::Zero(d);
  const auto one = hn::Set(d, 1);
  const auto last_size = hn::Set(d, WindowShelf::sizes - 1);
  const auto runs = static_cast<std::int32_t>(FindRuns(col_half, row_half, size_halves, points, run_begin));
  const auto all_runs = hn::Set(d, runs);
  auto unbounded = zero;
  auto weights = zero;
  auto least_col = hn::Set(d, std::numeric_limits<std::int32_t>::max());
  auto least_row = least_col;
  auto most_col = hn::Set(d, std::numeric_limits<std::int32_t>::min());
  auto most_row = most_col;
  for (std::int32_t run = 0; run < runs; run += lanes) {
    // What lies behind the last run is read, and left out.
    const auto is_run = hn::Lt(hn::Iota(d, run), all_runs);
    const auto begin = hn::IfThenElseZero(is_run, hn::LoadU(d, run_begin + run));
    const auto weight = hn::IfThenElseZero(is_run, hn::Sub(hn::LoadU(d, run_begin + run + 1), begin));
    const auto size = hn::IfThenElseZero(is_run, hn::GatherIndex(d, size_halves, begin));
    const auto col_of = hn::GatherIndex(d, col_half, begin);
    const auto row_of = hn::GatherIndex(d, row_half, begin);
    const auto plane_of = hn::GatherIndex(d, shelf.plane_of_size, hn::Min(size, last_size));
    const auto on_map = hn::Gt(size, zero);
    const auto too_wide = hn::And(on_map, hn::Lt(plane_of, zero));
    const auto kept = hn::AndNot(too_wide, on_map);
    unbounded = hn::Add(unbounded, hn::IfThenElseZero(too_wide, weight));
    const auto col = hn::Add(hn::ShiftRight<1>(col_of), hn::Set(d, shelf.pad_cols));
    const auto row = hn::Add(hn::ShiftRight<1>(row_of), hn::Set(d, shelf.pad_rows));
    least_col = hn::IfThenElse(kept, hn::Min(least_col, col), least_col);
    least_row = hn::IfThenElse(kept, hn::Min(least_row, row), least_row);
    most_col = hn::IfThenElse(kept, hn::Max(most_col, col), most_col);
    most_row = hn::IfThenElse(kept, hn::Max(most_row, row), most_row);
    const auto phase = hn::Add(hn::ShiftLeft<1>(hn::And(row_of, one)), hn::And(col_of, one));
    const auto plane = hn::Add(plane_of, hn::Mul(phase, hn::Set(d, shelf.plane_size)));
    const auto first = hn::Add(hn::Add(plane, col), hn::Mul(row, hn::Set(d, shelf.stride)));
    auto bits = hn::IfThenElseZero(kept, weight);
    weights = hn::Or(weights, bits);
    for (int bit = 0; !hn::AllTrue(d, hn::Eq(bits, zero)); ++bit, bits = hn::ShiftRight<1>(bits)) {
      const auto listed = hn::Ne(hn::And(bits, one), zero);
      const std::int32_t at = lists.end[bit];
      Append(plane, listed, lists.plane + at);
      Append(col, listed, lists.col + at);
      Append(row, listed, lists.row + at);
      Append(hn::ShiftLeft<2>(first), listed, lists.first_byte + at);
      lists.end[bit] = at + static_cast<std::int32_t>(hn::CountTrue(d, listed));
    }
  }
  HWY_ALIGN std::int32_t lane_weights[16];
  hn::Store(weights, d, lane_weights);
  MergedCount count;
  for (std::int32_t lane = 0; lane < lanes; ++lane) count.weights |= lane_weights[lane];
  count.unbounded = hn::GetLane(hn::SumOfLanes(d, unbounded));
  if (count.weights == 0) return count;
  count.least_col = hn::GetLane(hn::MinOfLanes(d, least_col));
  count.least_row = hn::GetLane(hn::MinOfLanes(d, least_row));
  count.most_col = hn::GetLane(hn::MaxOfLanes(d, most_col));
  count.most_row = hn::GetLane(hn::MaxOfLanes(d, most_row));
  return count;
}

}  // namespace HWY_NAMESPACE
}  // namespace landfall::kernels
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace landfall::kernels {

namespace scalar {

MergedCount merge_windows(const std::int32_t* col_half, const std::int32_t* row_half,
                          const std::int32_t* size_halves, std::size_t points, const WindowShelf& shelf,
                          std::int32_t* /*run_begin*/, const WindowLists& lists) {
  begin_lists(points, lists);
  MergedCount count;
  for (std::size_t i = 0, end = 0; i < points; i = end) {
    const auto equal = [&](std::size_t other) {
      return col_half[other] == col_half[i] && row_half[other] == row_half[i] &&
             size_halves[other] == size_halves[i];
    };
    for (end = i + 1; end < points && equal(end);) ++end;
    const auto weight = static_cast<std::int32_t>(end - i);
    if (size_halves[i] == 0) continue;
    const std::int32_t plane_of = shelf.plane_of_size[std::min(size_halves[i], WindowShelf::sizes - 1)];
    if (plane_of < 0) {
      count.unbounded += weight;
      continue;
    }
    const std::int32_t phase = 2 * (row_half[i] & 1) + (col_half[i] & 1);
    const std::int32_t plane = plane_of + phase * shelf.plane_size;
    const std::int32_t col = (col_half[i] >> 1) + shelf.pad_cols;
    const std::int32_t row = (row_half[i] >> 1) + shelf.pad_rows;
    const bool first = count.weights == 0;
    count.least_col = first ? col : std::min(count.least_col, col);
    count.most_col = first ? col : std::max(count.most_col, col);
    count.least_row = first ? row : std::min(count.least_row, row);
    count.most_row = first ? row : std::max(count.most_row, row);
    count.weights |= weight;
    for (int bit = 0; weight >> bit != 0; ++bit) {
      if (((weight >> bit) & 1) == 0) continue;
      const std::int32_t at = lists.end[bit]++;
      lists.plane[at] = plane;
      lists.col[at] = col;
      lists.row[at] = row;
      lists.first_byte[at] = 4 * (plane + row * shelf.stride + col);
    }
  }
  return count;
}

}  // namespace scalar

HWY_EXPORT(MergeWindows);

MergedCount merge_windows(const std::int32_t* col_half, const std::int32_t* row_half,
                          const std::int32_t* size_halves, std::size_t points, const WindowShelf& shelf,
                          std::int32_t* run_begin, const WindowLists& lists) {
  const auto run = scalar_selected() ? scalar::merge_windows : HWY_DYNAMIC_DISPATCH(MergeWindows);
  return run(col_half, row_half, size_halves, points, shelf, run_begin, lists);
}

}  // namespace landfall::kernels
#endif
