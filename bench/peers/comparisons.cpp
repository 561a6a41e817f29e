#include "bench/peers/comparisons.hpp"

#include <cstdio>

namespace landfall::bench {

bool compare_with_peers(const Place& place) {
  if (!compare_search(place) || !compare_dense_correlation(place)) return false;
#if LANDFALL_BENCH_MRPT
  if (!compare_likelihood_field(place) || !compare_laser_scan(place)) return false;
#endif
  return true;
}

void report_missing_peers() {
  const auto report = [](const char* name, bool there) {
    if (!there) std::fprintf(stderr, "skipped: %s is not installed\n", name);
  };
  report("OpenCV", LANDFALL_BENCH_OPENCV);
  report("FFTW", LANDFALL_BENCH_FFTW);
  report("MRPT", LANDFALL_BENCH_MRPT);
}

}  // namespace landfall::bench
