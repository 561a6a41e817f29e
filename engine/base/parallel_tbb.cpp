// parallel.hpp on oneTBB.
#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>

#include "engine/base/executor.hpp"
#include "engine/base/first_failure.hpp"

namespace landfall::internal {
namespace {

int offered_threads() {
  using tbb::global_control;
  const std::size_t allowed = global_control::active_value(global_control::max_allowed_parallelism);
  return std::min(static_cast<int>(allowed), tbb::this_task_arena::max_concurrency());
}

int tbb_thread_count(int threads) {
  return threads > 0 ? std::min(threads, offered_threads()) : offered_threads();
}

void run_tasks(std::size_t count, const std::function<void(std::size_t)>& body) {
  tbb::this_task_arena::isolate(
      [&] { tbb::parallel_for(std::size_t{0}, count, body, tbb::simple_partitioner()); });
}

// A task per thread, each takes what is next: the caller's arena stays the one that has the threads. A
// narrower arena would bring threads of its own beside those of a host's.
void run_on_some(std::size_t count, int threads, const std::function<void(std::size_t)>& body) {
  std::atomic<std::size_t> next{0};
  FirstFailure failure;
  run_tasks(static_cast<std::size_t>(threads), [&](std::size_t) {
    for (std::size_t i = next++; i < count; i = next++) failure.guard([&] { body(i); });
  });
  failure.rethrow();
}

void tbb_parallel_for(std::size_t count, int threads, const std::function<void(std::size_t)>& body) {
  const int wanted = tbb_thread_count(threads);
  if (wanted == offered_threads())
    run_tasks(count, body);
  else
    run_on_some(count, wanted, body);
}

// In a task, or sent to an arena that is narrower than the machine.
bool inside_tbb_region() {
  return tbb::task::current_context() != nullptr ||
         tbb::this_task_arena::max_concurrency() < tbb::info::default_concurrency();
}

}  // namespace

const Executor tbb_executor{.name = "tbb",
                            .thread_count = tbb_thread_count,
                            .parallel_for = tbb_parallel_for,
                            .host_is_spread = inside_tbb_region};

}  // namespace landfall::internal
