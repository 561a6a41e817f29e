#include "engine/parallel.hpp"

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>

namespace landfall::internal {

int thread_count(int threads) {
  using tbb::global_control;
  // An arena wider than what is allowed makes oneTBB warn on the standard error stream.
  const std::size_t allowed = global_control::active_value(global_control::max_allowed_parallelism);
  return threads > 0 ? std::min(threads, static_cast<int>(allowed)) : tbb::this_task_arena::max_concurrency();
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
  if (threads == 0 || thread_count(threads) == tbb::this_task_arena::max_concurrency()) {
    run();
  } else {
    tbb::task_arena arena(thread_count(threads));
    arena.execute(run);
  }
}

}  // namespace landfall::internal
