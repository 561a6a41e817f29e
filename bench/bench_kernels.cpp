// The search's inner loops on every instruction set of this machine. Each is held to its plain twin before
// it is timed. One thread. `load_bytes/s`: the rate at which the same instruction set loads and adds as many
// bytes in order, measured just before: the bound kernel's limit. `split_load_bytes/s`: the same from an
// address off the cache lines' beginnings, as most of that kernel's loads are.
#include <benchmark/benchmark.h>

#include <cstdio>
#include <string>
#include <vector>

#include "bench/context.hpp"
#include "bench/kernel_work.hpp"
#include "bench/load_bandwidth.hpp"
#include "tests/instruction_sets.hpp"

namespace landfall::bench {
namespace {

bool equals_twin(const Work& work) {
  Answers answers;
  Answers of_twin;
  work.run(false, answers);
  work.run(true, of_twin);
  return answers == of_twin && sum_bytes(work.table) == scalar::sum_bytes(work.table);
}

void time_work(benchmark::State& state, const Work& work, const std::string& isa) {
  const testing::UsedInstructionSet used(isa);
  const LoadRates limits = work.table.empty() ? LoadRates{} : measure_loads(work.table.size());
  Answers answers;
  for (auto _ : state) {
    work.run(false, answers);
    benchmark::ClobberMemory();
  }
  const double units = static_cast<double>(state.iterations()) * work.units_per_run;
  state.counters[work.unit] = benchmark::Counter(units, benchmark::Counter::kIsRate);
  if (limits.aligned_bytes_per_s > 0.0) {
    state.counters["load_bytes/s"] = limits.aligned_bytes_per_s;
    state.counters["split_load_bytes/s"] = limits.split_bytes_per_s;
  }
}

bool register_work(const Work& work) {
  for (const std::string& isa : testing::instruction_sets()) {
    const testing::UsedInstructionSet used(isa);
    if (!equals_twin(work)) {
      std::fprintf(stderr, "%s: %s differs from its plain twin\n", work.name.c_str(), isa.c_str());
      return false;
    }
    benchmark::RegisterBenchmark((work.name + "/" + isa).c_str(), [&work, isa](benchmark::State& state) {
      time_work(state, work, isa);
    })->Unit(benchmark::kMicrosecond);
  }
  return true;
}

}  // namespace
}  // namespace landfall::bench

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  landfall::bench::name_instruction_set_and_executor();
  const std::vector<landfall::bench::Work> all = landfall::bench::all_work();
  for (const landfall::bench::Work& work : all)
    if (!landfall::bench::register_work(work)) return 1;
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}
