#include "kernels/window_max.hpp"

#include <algorithm>

namespace landfall::kernels {

void maximum(const std::uint8_t* a, const std::uint8_t* b, std::size_t count, std::uint8_t* out) {
  for (std::size_t c = 0; c < count; ++c) out[c] = a[c] > b[c] ? a[c] : b[c];
}

void sliding_max_8(const std::uint8_t* in, std::size_t count, std::uint8_t* scratch, std::uint8_t* out) {
  if (count < 8) return;
  maximum(in, in + 1, count - 1, out);            // windows of 2
  maximum(out, out + 2, count - 3, scratch);      // of 4
  maximum(scratch, scratch + 4, count - 7, out);  // of 8
}

void interleave_2(const std::uint8_t* a, const std::uint8_t* b, std::size_t count, std::uint16_t* out) {
  for (std::size_t i = 0; i < count; ++i) out[i] = static_cast<std::uint16_t>(a[i] | b[i] << 8);
}

void interleave_4(const std::uint8_t* a, const std::uint8_t* b, const std::uint8_t* c, const std::uint8_t* d,
                  std::size_t count, std::uint32_t* out) {
  for (std::size_t i = 0; i < count; ++i) {
    out[i] = std::uint32_t{a[i]} | std::uint32_t{b[i]} << 8U | std::uint32_t{c[i]} << 16U |
             std::uint32_t{d[i]} << 24U;
  }
}

void reduce_max(const std::uint8_t* in, std::size_t count, std::size_t factor, std::uint8_t* out) {
  for (std::size_t first = 0; first < count; first += factor) {
    const std::size_t last = std::min(count, first + factor);
    *out++ = *std::max_element(in + first, in + last);
  }
}

}  // namespace landfall::kernels
