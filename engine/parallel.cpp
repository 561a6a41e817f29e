#include "engine/parallel.hpp"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

namespace landfall::internal {

int thread_count(int threads) {
  return threads > 0 ? threads : tbb::this_task_arena::max_concurrency();
}

void parallel_for(std::size_t count, int threads, const std::function<void(std::size_t)>& body) {
  if (thread_count(threads) == 1 || count < 2) {
    for (std::size_t i = 0; i < count; ++i) body(i);
    return;
  }
  const auto run = [&] {
    tbb::this_task_arena::isolate(
        [&] { tbb::parallel_for(std::size_t{0}, count, body, tbb::simple_partitioner()); });
  };
  if (threads == 0 || threads == tbb::this_task_arena::max_concurrency()) {
    run();
  } else {
    tbb::task_arena arena(threads);
    arena.execute(run);
  }
}

}  // namespace landfall::internal
