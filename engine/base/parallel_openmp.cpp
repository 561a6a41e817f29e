// parallel.hpp on OpenMP, for hosts that run on it.
#include <algorithm>

#include "engine/base/executor.hpp"
#include "engine/base/first_failure.hpp"

// Of <omp.h>, as the OpenMP standard declares them: gcc's does not parse under clang 14.
extern "C" {
int omp_get_active_level();
int omp_get_max_active_levels();
int omp_get_max_threads();
int omp_get_num_procs();
int omp_get_thread_limit();
}

namespace landfall::internal {
namespace {

// Level 0 is outside of all regions of more than one thread.
bool inside_openmp_region() {
  return omp_get_active_level() > 0;
}

int openmp_thread_count(int threads) {
  const bool inside = inside_openmp_region();
  if (inside && omp_get_active_level() >= omp_get_max_active_levels()) return 1;
  const int offered = omp_get_max_threads();
  const int most = inside ? offered : std::max(omp_get_num_procs(), offered);
  return std::min(threads > 0 ? std::min(threads, most) : offered, omp_get_thread_limit());
}

void openmp_parallel_for(std::size_t count, int threads, const std::function<void(std::size_t)>& body) {
  const auto team = static_cast<int>(std::min(count, static_cast<std::size_t>(openmp_thread_count(threads))));
  FirstFailure failure;
#pragma omp parallel for schedule(dynamic, 1) num_threads(team)
  for (std::size_t i = 0; i < count; ++i) failure.guard([&] { body(i); });
  failure.rethrow();
}

}  // namespace

const Executor openmp_executor{.name = "openmp",
                               .thread_count = openmp_thread_count,
                               .parallel_for = openmp_parallel_for,
                               .host_is_spread = inside_openmp_region};

}  // namespace landfall::internal
