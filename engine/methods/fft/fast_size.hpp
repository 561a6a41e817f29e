// Sizes that transforms are fast at.
#pragma once

namespace landfall::internal {

// The least multiple of 4 not below `least` whose only prime factors are 2, 3 and 5. Multiples of 4: rows
// of reals stay aligned, and halves of them even.
inline int fast_size(int least) {
  for (int size = (least + 3) / 4 * 4;; size += 4) {
    int rest = size;
    for (const int factor : {2, 3, 5})
      while (rest % factor == 0) rest /= factor;
    if (rest == 1) return size;
  }
}

}  // namespace landfall::internal
