// Random inputs of the kernels.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/base/counter_rng.hpp"

namespace landfall::testing {

// Numbers of points that straddle every vector width and every flush of 16-bit sums.
inline constexpr int point_counts[] = {0, 1, 7, 8, 9, 31, 32, 33, 47, 48, 49, 255, 256, 257, 258, 1000};

inline std::size_t area(int width, int height) {
  return static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
}

class RandomField {
 public:
  explicit RandomField(std::uint64_t seed) : rng_(seed) {}

  int between(int low, int high) {
    return low + static_cast<int>(rng_.below(static_cast<std::uint32_t>(high - low + 1)));
  }
  double uniform(double low, double high) { return low + (high - low) * rng_.uniform(); }

  // Bytes of 0 .. most, some 0 and some `most`.
  std::vector<std::uint8_t> bytes(std::size_t count, int most = 255) {
    std::vector<std::uint8_t> values(count);
    for (std::uint8_t& value : values) {
      const int kind = between(0, 3);
      value = static_cast<std::uint8_t>(kind == 0 ? 0 : kind == 1 ? most : between(0, most));
    }
    return values;
  }
  std::vector<std::int32_t> integers(std::size_t count, int low, int high) {
    std::vector<std::int32_t> values(count);
    for (std::int32_t& value : values) value = between(low, high);
    return values;
  }

 private:
  internal::CounterRng rng_;
};

}  // namespace landfall::testing
