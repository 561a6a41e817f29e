// The best score that any thread of a search has found.
#pragma once

#include <atomic>
#include <cstdint>

namespace landfall::internal {

class BestScore {
 public:
  [[nodiscard]] std::int32_t get() const { return best_.load(std::memory_order_relaxed); }
  void raise(std::int32_t score) {
    std::int32_t known = get();
    while (score > known && !best_.compare_exchange_weak(known, score, std::memory_order_relaxed)) {
    }
  }

 private:
  std::atomic<std::int32_t> best_{0};
};

}  // namespace landfall::internal
