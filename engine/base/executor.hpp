// The schedulers behind parallel.hpp, chosen by the environment variable LANDFALL_EXECUTOR:
//   tbb      oneTBB (the default): callers share one set of threads. The arena of the calling thread is used,
//            never more threads than it has
//   openmp   for hosts that run on OpenMP and set its thread counts: every calling thread has a team of its
//            own. Inside a region, a team of what the host offers there (omp_get_max_threads); 1 where
//            regions may not nest (omp_get_max_active_levels)
// Inside a host's region of the other scheduler work runs in the calling thread alone: the host has its
// threads busy. A build without OpenMP (CMake option LANDFALL_OPENMP) cannot see OpenMP's regions.
// Embree builds its scenes with oneTBB whatever is chosen here.
#pragma once

#include <cstddef>
#include <functional>
#include <span>

namespace landfall::internal {

struct Executor {
  const char* name;
  int (*thread_count)(int threads);
  // Called with two indices and two threads at least.
  void (*parallel_for)(std::size_t count, int threads, const std::function<void(std::size_t)>& body);
  // This thread is inside a region of this scheduler's: no other scheduler is to start threads beside it.
  bool (*host_is_spread)();
};

extern const Executor tbb_executor;
extern const Executor openmp_executor;
extern const Executor plain_threads_executor;

// Of this build; the first is the default.
std::span<const Executor* const> executors();

// The one in use. LANDFALL_EXECUTOR is read on first need; a name there that this build lacks throws
// Error{unknown_name}.
const Executor& executor();

// Use this one from now on; nullptr or "" gives what the environment says again. False, and nothing
// changed, where this build lacks the name. Not for use while regions run.
bool select_executor(const char* name);

}  // namespace landfall::internal
