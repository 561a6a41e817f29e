// Tasks over indices. The one place that knows the scheduler; the only door through which an exception
// leaves a parallel region.
#pragma once

#include <cstddef>
#include <functional>

namespace landfall::internal {

// Threads that `threads` asks for: itself, as far as the machine has them, or all that the caller's
// arena offers for 0.
int thread_count(int threads);

// body(i) for i in [0, count), on up to `threads` threads (0: all; 1: in this thread, in order).
// A thread that waits here takes no work of other parallel regions, so it may hold a std::once_flag.
void parallel_for(std::size_t count, int threads, const std::function<void(std::size_t)>& body);

}  // namespace landfall::internal
