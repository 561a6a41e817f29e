// Tasks over indices. The one door to the scheduler, and the only one through which an exception leaves a
// parallel region: the first that was thrown; what has not begun by then is left out. Which scheduler, and
// what a host's own parallel regions mean to it: executor.hpp.
#pragma once

#include <cstddef>
#include <functional>

namespace landfall::internal {

// Threads that `threads` asks for: itself, as far as the caller's arena or OpenMP settings offer them, or all
// of these for 0. 1 where the host has spread its work by another scheduler.
int thread_count(int threads);

// body(i) for i in [0, count), on up to `threads` threads (0: all; 1: in this thread, in order).
// A thread that waits here takes no work of other parallel regions, so it may hold a std::once_flag.
void parallel_for(std::size_t count, int threads, const std::function<void(std::size_t)>& body);

}  // namespace landfall::internal
