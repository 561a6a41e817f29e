// parallel.hpp on plain threads, for the thread sanitizer: it sees what these hand over, and nothing of what
// Debian's oneTBB and OpenMP do. Threads are started anew for every region.
#include <algorithm>
#include <atomic>
#include <thread>
#include <vector>

#include "engine/base/executor.hpp"
#include "engine/base/first_failure.hpp"

namespace landfall::internal {
namespace {

int plain_thread_count(int threads) {
  return threads > 0 ? threads : std::max(2, static_cast<int>(std::thread::hardware_concurrency()));
}

void plain_parallel_for(std::size_t count, int threads, const std::function<void(std::size_t)>& body) {
  std::atomic<std::size_t> next{0};
  FirstFailure failure;
  const auto work = [&] {
    for (std::size_t i = next++; i < count; i = next++) failure.guard([&] { body(i); });
  };
  {
    std::vector<std::jthread> helpers;
    const std::size_t wanted = std::min(count, static_cast<std::size_t>(plain_thread_count(threads)));
    for (std::size_t i = 1; i < wanted; ++i) helpers.emplace_back(work);
    work();
  }
  failure.rethrow();
}

bool never_spread() {
  return false;
}

}  // namespace

const Executor plain_threads_executor{.name = "threads",
                                      .thread_count = plain_thread_count,
                                      .parallel_for = plain_parallel_for,
                                      .host_is_spread = never_spread};

}  // namespace landfall::internal
