// Four rows of 16 sums: of 64 poses of a block, or of 64 blocks of a tile. Highway compiles this once for
// each instruction set of the file that includes it.
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
