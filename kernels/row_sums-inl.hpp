// Four rows of 16 bytes at every offset, summed up: 64 poses of a block, or 64 blocks of a tile. Highway
// compiles this once for each instruction set of the file that includes it.
#if defined(LANDFALL_KERNELS_ROW_SUMS_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef LANDFALL_KERNELS_ROW_SUMS_INL_HPP
#undef LANDFALL_KERNELS_ROW_SUMS_INL_HPP
#else
#define LANDFALL_KERNELS_ROW_SUMS_INL_HPP
#endif

#include <hwy/highway.h>

#include <cstddef>
#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace landfall::kernels {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

constexpr std::size_t sum_rows = 4;
constexpr std::size_t sums_a_row = 16;
constexpr std::size_t row_sums = sum_rows * sums_a_row;
// 16 bits hold the sum of 257 bytes; 256 are a whole number of looks.
constexpr std::size_t addends_a_word = 256;

// Rows that stand `row_bytes` apart in `bytes`.
struct Rows {
  const std::uint8_t* bytes;
  std::ptrdiff_t row_bytes;
};

// sums[row * 16 + lane] += rows.bytes[scale * offset[i] + row * row_bytes + lane], for the first `Count` rows
// (1 to 4) and all i.
#if HWY_TARGET <= HWY_AVX2 && HWY_ARCH_X86
// All sums stay in registers, one a row.
template <int Scale, int Count = static_cast<int>(sum_rows)>
HWY_INLINE void AddRows(const Rows& rows, const std::int32_t* HWY_RESTRICT offset, std::size_t count,
                        std::uint16_t* HWY_RESTRICT sums) {
  const hn::FixedTag<std::uint16_t, sums_a_row> d;
  const hn::Rebind<std::uint8_t, decltype(d)> d_byte;
  const auto add = [&](auto sum, const std::uint8_t* row)
                       HWY_ATTR { return hn::Add(sum, hn::PromoteTo(d, hn::LoadU(d_byte, row))); };
  auto sum0 = hn::Load(d, sums);
  auto sum1 = sum0, sum2 = sum0, sum3 = sum0;
  if constexpr (Count > 1) sum1 = hn::Load(d, sums + sums_a_row);
  if constexpr (Count > 2) sum2 = hn::Load(d, sums + 2 * sums_a_row);
  if constexpr (Count > 3) sum3 = hn::Load(d, sums + 3 * sums_a_row);
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint8_t* first = rows.bytes + Scale * static_cast<std::ptrdiff_t>(offset[i]);
    sum0 = add(sum0, first);
    if constexpr (Count > 1) sum1 = add(sum1, first + rows.row_bytes);
    if constexpr (Count > 2) sum2 = add(sum2, first + 2 * rows.row_bytes);
    if constexpr (Count > 3) sum3 = add(sum3, first + 3 * rows.row_bytes);
  }
  hn::Store(sum0, d, sums);
  if constexpr (Count > 1) hn::Store(sum1, d, sums + sums_a_row);
  if constexpr (Count > 2) hn::Store(sum2, d, sums + 2 * sums_a_row);
  if constexpr (Count > 3) hn::Store(sum3, d, sums + 3 * sums_a_row);
}
#else
template <int Scale, int Count = static_cast<int>(sum_rows)>
HWY_INLINE void AddRows(const Rows& rows, const std::int32_t* HWY_RESTRICT offset, std::size_t count,
                        std::uint16_t* HWY_RESTRICT sums) {
  const hn::CappedTag<std::uint16_t, sums_a_row> d;
  const hn::Rebind<std::uint8_t, decltype(d)> d_byte;
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t row = 0; row < Count; ++row) {
      const std::uint8_t* first = rows.bytes + Scale * static_cast<std::ptrdiff_t>(offset[i]) +
                                  static_cast<std::ptrdiff_t>(row) * rows.row_bytes;
      for (std::size_t lane = 0; lane < sums_a_row; lane += hn::Lanes(d)) {
        std::uint16_t* sum = sums + row * sums_a_row + lane;
        hn::Store(hn::Add(hn::Load(d, sum), hn::PromoteTo(d, hn::LoadU(d_byte, first + lane))), d, sum);
      }
    }
}
#endif

// The largest of the sums, where `counted` is all ones.
HWY_INLINE std::int32_t LargestSum(const std::uint16_t* HWY_RESTRICT sums,
                                   const std::uint16_t* HWY_RESTRICT counted) {
  const hn::CappedTag<std::uint16_t, row_sums / 2> d;
  auto largest = hn::Zero(d);
  for (std::size_t lane = 0; lane < row_sums; lane += hn::Lanes(d))
    largest = hn::Max(largest, hn::And(hn::LoadU(d, sums + lane), hn::LoadU(d, counted + lane)));
  return hn::GetLane(hn::MaxOfLanes(d, largest));
}
HWY_INLINE std::int32_t LargestSum(const std::uint16_t* HWY_RESTRICT sums) {
  return LargestSum(sums, sums);
}

}  // namespace HWY_NAMESPACE
}  // namespace landfall::kernels
HWY_AFTER_NAMESPACE();
#endif
