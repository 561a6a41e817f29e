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

// Median rate (by processor time) of sum_bytes over the same bytes again and again: what the cache that
// they fit into gives.
double load_bytes_per_s(std::span<const std::uint8_t> bytes);

}  // namespace landfall::bench
