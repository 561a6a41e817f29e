#include "engine/base/parallel.hpp"

#include <algorithm>

#include "engine/base/executor.hpp"

namespace landfall::internal {

int thread_count(int threads) {
  const Executor& used = executor();
  for (const Executor* other : executors())
    if (other != &used && other->host_is_spread()) return 1;
  return used.thread_count(threads);
}

void parallel_for(std::size_t count, int threads, const std::function<void(std::size_t)>& body) {
  if (count < 2 || threads == 1 || thread_count(threads) == 1) {
    for (std::size_t i = 0; i < count; ++i) body(i);
  } else {
    executor().parallel_for(count, threads, body);
  }
}

}  // namespace landfall::internal
