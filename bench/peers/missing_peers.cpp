#include <cstdio>

#include "bench/peers/comparisons.hpp"

namespace landfall::bench {

void report_missing_peers() {
  const auto report = [](const char* name, bool there) {
    if (!there) std::fprintf(stderr, "skipped: %s is not installed\n", name);
  };
  report("OpenCV", LANDFALL_BENCH_OPENCV);
  report("FFTW", LANDFALL_BENCH_FFTW);
}

}  // namespace landfall::bench
