// The limit that kernels are held against: how fast this machine loads and adds bytes that lie in order.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace landfall::bench {

// The bytes' sum modulo 256, with the instruction set that the kernels use now; the count is a multiple
// of 512.
std::uint8_t sum_bytes(std::span<const std::uint8_t> bytes);

namespace scalar {
std::uint8_t sum_bytes(std::span<const std::uint8_t> bytes);
}

// Median rates (by processor time) of sum_bytes over so many bytes again and again, a multiple of 512: what
// the cache that they fit into gives.
struct LoadRates {
  double aligned_bytes_per_s = 0.0;  // from the beginning of a cache line
  double split_bytes_per_s = 0.0;    // from 4 bytes behind it
};
LoadRates measure_loads(std::size_t bytes);

}  // namespace landfall::bench
