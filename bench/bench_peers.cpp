// Peers side by side with landfall: bench/peers/comparisons.hpp. On a made-up office, and where the data are
// on the Intel lab.
#include <benchmark/benchmark.h>

#include "bench/context.hpp"
#include "bench/peers/comparisons.hpp"

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  landfall::bench::name_instruction_set_and_executor();
  const std::vector<landfall::bench::Place> places = landfall::bench::office_and({"intel"});
  landfall::bench::report_missing_peers();
  for (const landfall::bench::Place& place : places)
    if (!landfall::bench::compare_with_peers(place)) return 1;
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}
