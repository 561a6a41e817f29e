// Every instruction set of this machine in turn.
#pragma once

#include <array>
#include <cstdlib>
#include <string>
#include <vector>

#include "kernels/isa.hpp"
#include "landfall/search.hpp"

namespace landfall::testing {

// Uses one by name until it goes out of scope.
class UsedInstructionSet {
 public:
  explicit UsedInstructionSet(const std::string& name) {
    (void)active_isa();  // LANDFALL_ISA is read once, here at the latest
    kernels::select_isa(name.c_str());
  }
  ~UsedInstructionSet() { kernels::select_isa(std::getenv("LANDFALL_ISA")); }
  UsedInstructionSet(const UsedInstructionSet&) = delete;
  UsedInstructionSet& operator=(const UsedInstructionSet&) = delete;
};

// Of any machine, best first; tests/CMakeLists.txt has the same list.
constexpr std::array instruction_set_names{
    "AVX3_SPR",  "AVX3_ZEN4", "AVX3_DL",          "AVX3",    "AVX2",  "SSE4",
    "SSSE3",     "SSE2",      "SVE2_128",         "SVE_256", "SVE2",  "SVE",
    "NEON_BF16", "NEON",      "NEON_WITHOUT_AES", "EMU128",  "SCALAR"};

inline std::vector<std::string> instruction_sets() {
  std::vector<std::string> of_this_machine;
  for (const char* name : instruction_set_names) {
    if (kernels::select_isa(name)) of_this_machine.emplace_back(name);
  }
  kernels::select_isa(nullptr);
  kernels::select_isa(std::getenv("LANDFALL_ISA"));
  return of_this_machine;
}

}  // namespace landfall::testing
