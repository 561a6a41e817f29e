#pragma once

#include <ctime>

namespace landfall::internal {

// Processor time of this thread: what else the machine does hardly shows in it.
inline double thread_time_ms() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

}  // namespace landfall::internal
