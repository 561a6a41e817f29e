#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bench/load_bandwidth.cpp"
#include <hwy/foreach_target.h>
// foreach_target comes before highway.h
#include <hwy/highway.h>

#include <algorithm>
#include <array>
#include <ctime>
#include <vector>

#include "bench/load_bandwidth.hpp"
#include "kernels/isa.hpp"

HWY_BEFORE_NAMESPACE();
namespace landfall::bench {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// As many sums as the dense bound kernel keeps.
std::uint8_t sum_vectors(const std::uint8_t* HWY_RESTRICT bytes, std::size_t count) {
  const hn::ScalableTag<std::uint8_t> d;
  const std::size_t lanes = hn::Lanes(d);
  auto sum0 = hn::Zero(d), sum1 = sum0, sum2 = sum0, sum3 = sum0;
  auto sum4 = sum0, sum5 = sum0, sum6 = sum0, sum7 = sum0;
  for (std::size_t i = 0; i < count; i += 8 * lanes) {
    sum0 = hn::Add(sum0, hn::LoadU(d, bytes + i));
    sum1 = hn::Add(sum1, hn::LoadU(d, bytes + i + lanes));
    sum2 = hn::Add(sum2, hn::LoadU(d, bytes + i + 2 * lanes));
    sum3 = hn::Add(sum3, hn::LoadU(d, bytes + i + 3 * lanes));
    sum4 = hn::Add(sum4, hn::LoadU(d, bytes + i + 4 * lanes));
    sum5 = hn::Add(sum5, hn::LoadU(d, bytes + i + 5 * lanes));
    sum6 = hn::Add(sum6, hn::LoadU(d, bytes + i + 6 * lanes));
    sum7 = hn::Add(sum7, hn::LoadU(d, bytes + i + 7 * lanes));
  }
  const auto all = hn::Add(hn::Add(hn::Add(sum0, sum1), hn::Add(sum2, sum3)),
                           hn::Add(hn::Add(sum4, sum5), hn::Add(sum6, sum7)));
  HWY_ALIGN std::uint8_t lane_sums[HWY_MAX_BYTES] = {};
  hn::Store(all, d, lane_sums);
  std::uint8_t sum = 0;
  for (std::size_t lane = 0; lane < lanes; ++lane) sum = static_cast<std::uint8_t>(sum + lane_sums[lane]);
  return sum;
}

}  // namespace HWY_NAMESPACE
}  // namespace landfall::bench
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace landfall::bench {

namespace scalar {
std::uint8_t sum_bytes(std::span<const std::uint8_t> bytes) {
  std::uint8_t sum = 0;
  for (const std::uint8_t byte : bytes) sum = static_cast<std::uint8_t>(sum + byte);
  return sum;
}
}  // namespace scalar

HWY_EXPORT(sum_vectors);

std::uint8_t sum_bytes(std::span<const std::uint8_t> bytes) {
  return kernels::scalar_selected() ? scalar::sum_bytes(bytes)
                                    : HWY_DYNAMIC_DISPATCH(sum_vectors)(bytes.data(), bytes.size());
}

namespace {

double load_bytes_per_s(std::span<const std::uint8_t> bytes) {
  constexpr std::size_t bytes_per_turn = std::size_t{1} << 24;
  const std::size_t passes = std::max<std::size_t>(1, bytes_per_turn / bytes.size());
  std::array<double, 9> rates{};
  volatile std::uint8_t kept = 0;
  for (int warm = 0; warm < 8; ++warm) kept = sum_bytes(bytes);
  for (double& rate : rates) {
    const std::clock_t start = std::clock();
    for (std::size_t pass = 0; pass < passes; ++pass) kept = sum_bytes(bytes);
    const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    rate = static_cast<double>(passes * bytes.size()) / seconds;
  }
  (void)kept;
  std::nth_element(rates.begin(), rates.begin() + rates.size() / 2, rates.end());
  return rates[rates.size() / 2];
}

}  // namespace

LoadRates measure_loads(std::size_t bytes) {
  constexpr std::size_t line = 64;
  constexpr std::size_t off = 4;
  const std::vector<std::uint8_t> buffer(bytes + 2 * line, 1);
  const std::size_t past = reinterpret_cast<std::uintptr_t>(buffer.data()) % line;
  const std::span<const std::uint8_t> from_line = std::span(buffer).subspan((line - past) % line);
  return {.aligned_bytes_per_s = load_bytes_per_s(from_line.first(bytes)),
          .split_bytes_per_s = load_bytes_per_s(from_line.subspan(off, bytes))};
}

}  // namespace landfall::bench
#endif
