// parallel.hpp on oneTBB.
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task.h>
#include <tbb/task_arena.h>

#include <algorithm>

#include "engine/executor.hpp"

namespace landfall::internal {
namespace {

int tbb_thread_count(int threads) {
  using tbb::global_control;
  // An arena wider than what is allowed makes oneTBB warn on the standard error stream.
  const std::size_t allowed = global_control::active_value(global_control::max_allowed_parallelism);
  return threads > 0 ? std::min(threads, static_cast<int>(allowed)) : tbb::this_task_arena::max_concurrency();
}

void tbb_parallel_for(std::size_t count, int threads, const std::function<void(std::size_t)>& body) {
  const auto run = [&] {
    tbb::this_task_arena::isolate(
        [&] { tbb::parallel_for(std::size_t{0}, count, body, tbb::simple_partitioner()); });
  };
  if (threads == 0 || tbb_thread_count(threads) == tbb::this_task_arena::max_concurrency()) {
    run();
  } else {
    tbb::task_arena arena(tbb_thread_count(threads));
    arena.execute(run);
  }
}

bool inside_tbb_task() {
  return tbb::task::current_context() != nullptr;
}

}  // namespace

const Executor tbb_executor{.name = "tbb",
                            .thread_count = tbb_thread_count,
                            .parallel_for = tbb_parallel_for,
                            .host_is_spread = inside_tbb_task};

}  // namespace landfall::internal
