// What a suite's numbers depend on beside the machine, for the head of its output.
#pragma once

#include <benchmark/benchmark.h>

#include "landfall/search.hpp"

namespace landfall::bench {

inline void name_instruction_set_and_executor() {
  benchmark::AddCustomContext("instruction set", active_isa());
  benchmark::AddCustomContext("executor", active_executor());
}

}  // namespace landfall::bench
