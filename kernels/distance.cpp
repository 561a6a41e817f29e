#include "kernels/distance.hpp"

#include <algorithm>

namespace landfall::kernels {

void column_distances(const std::uint8_t* occupied, int width, int height, int cap, int first_col,
                      int last_col, std::uint16_t* distance) {
  const auto none = static_cast<std::uint16_t>(cap);
  const std::ptrdiff_t stride = width;
  for (std::ptrdiff_t row = 0; row < height; ++row) {
    const std::uint8_t* in = occupied + row * stride;
    std::uint16_t* out = distance + row * stride;
    const std::uint16_t* below = row > 0 ? out - stride : nullptr;
    for (int c = first_col; c < last_col; ++c) {
      const int from_below = below != nullptr ? std::min(below[c] + 1, cap) : cap;
      out[c] = in[c] != 0 ? std::uint16_t{0} : static_cast<std::uint16_t>(from_below);
    }
  }
  for (std::ptrdiff_t row = std::ptrdiff_t{height} - 2; row >= 0; --row) {
    std::uint16_t* out = distance + row * stride;
    for (int c = first_col; c < last_col; ++c) {
      out[c] = std::min({out[c], static_cast<std::uint16_t>(std::min(out[c + stride] + 1, cap)), none});
    }
  }
}

void clamped_row(const std::uint16_t* column_distance, int width, int radius, std::int32_t* squared) {
  const std::int32_t limit = (radius + 1) * (radius + 1);
  for (int c = 0; c < width; ++c) {
    const std::int32_t up = column_distance[c];
    squared[c] = std::min(limit, up * up);
  }
  for (int shift = 1; shift <= radius; ++shift) {
    const std::int32_t across = shift * shift;
    for (int c = 0; c + shift < width; ++c) {
      const std::int32_t up = column_distance[c + shift];
      squared[c] = std::min(squared[c], up * up + across);
    }
    for (int c = shift; c < width; ++c) {
      const std::int32_t up = column_distance[c - shift];
      squared[c] = std::min(squared[c], up * up + across);
    }
  }
}

void exact_row(const std::uint16_t* column_distance, int width, int cap, std::int32_t* scratch,
               std::int32_t* squared) {
  std::int32_t* apex = scratch;              // columns whose parabolas form the envelope
  std::int32_t* from = scratch + width + 1;  // first column where each of them is lowest
  const auto height_at = [&](std::int64_t c) {
    const std::int64_t up = column_distance[c];
    return up * up;
  };
  int count = 0;
  for (int c = 0; c < width; ++c) {
    if (column_distance[c] >= cap) continue;
    while (true) {
      if (count == 0) {
        from[0] = 0;
        break;
      }
      const std::int64_t a = apex[count - 1];
      // First column at which c's parabola lies below a's.
      const std::int64_t numerator = (height_at(c) + std::int64_t{c} * c) - (height_at(a) + a * a);
      const std::int64_t twice = 2 * (std::int64_t{c} - a);
      const std::int64_t meet =
          numerator >= 0 ? numerator / twice + 1 : -((-numerator + twice - 1) / twice) + 1;
      if (meet <= from[count - 1]) {
        --count;
        continue;
      }
      if (meet >= width) {
        from[count] = width;
      } else {
        from[count] = static_cast<std::int32_t>(meet);
      }
      break;
    }
    if (count > 0 && from[count] >= width) continue;
    apex[count++] = c;
  }
  for (int c = 0, k = 0; c < width; ++c) {
    if (count == 0) {
      squared[c] = far_squared;
      continue;
    }
    while (k + 1 < count && from[k + 1] <= c) ++k;
    const std::int64_t across = std::int64_t{c} - apex[k];
    squared[c] =
        static_cast<std::int32_t>(std::min<std::int64_t>(far_squared, across * across + height_at(apex[k])));
  }
}

}  // namespace landfall::kernels
