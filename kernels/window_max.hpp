// Sliding maxima and the planes of the search that are made of them.
#pragma once

#include <cstddef>
#include <cstdint>

namespace landfall::kernels {

// out[c] = max(in[c], ..., in[c + 7]) for c in [0, count - 8]; every window of 8 cells.
// in and out may not overlap; scratch holds count bytes.
void sliding_max_8(const std::uint8_t* in, std::size_t count, std::uint8_t* scratch, std::uint8_t* out);

// out[c] = max(a[c], b[c]).
void maximum(const std::uint8_t* a, const std::uint8_t* b, std::size_t count, std::uint8_t* out);

// out[c]: bytes a[c], b[c] from the lowest byte up.
void interleave_2(const std::uint8_t* a, const std::uint8_t* b, std::size_t count, std::uint16_t* out);
// Bytes a[c], b[c], c_[c], d[c].
void interleave_4(const std::uint8_t* a, const std::uint8_t* b, const std::uint8_t* c, const std::uint8_t* d,
                  std::size_t count, std::uint32_t* out);

// out[c] = max over in[factor * c, factor * (c + 1)), the last one cut at count.
void reduce_max(const std::uint8_t* in, std::size_t count, std::size_t factor, std::uint8_t* out);

}  // namespace landfall::kernels
