#include "kernels/isa.hpp"

#include <hwy/targets.h>

#include <atomic>
#include <cstdint>
#include <string_view>

namespace landfall::kernels {
namespace {

std::atomic<bool> scalar{false};

// Highway numbers targets so that a better one of the same architecture is a lower bit.
std::int64_t best_of(std::int64_t targets) {
  return targets & -targets;
}

// The machine's target of that name; 0: none.
std::int64_t find_target(std::string_view name) {
  static const std::int64_t all = hwy::SupportedTargets();
  for (std::int64_t rest = all; rest != 0; rest &= rest - 1)
    if (name == hwy::TargetName(best_of(rest))) return best_of(rest);
  return 0;
}

}  // namespace

bool scalar_selected() {
  return scalar.load(std::memory_order_relaxed);
}

const char* isa_name() {
  return scalar_selected() ? "SCALAR" : hwy::TargetName(best_of(hwy::SupportedTargets()));
}

bool select_isa(const char* name) {
  const std::string_view wanted = name == nullptr ? "" : name;
  std::int64_t disabled = 0;  // none: the best
  if (!wanted.empty() && wanted != "SCALAR") {
    const std::int64_t target = find_target(wanted);
    if (target == 0) return false;
    disabled = target - 1;
  }
  scalar = wanted == "SCALAR";
  hwy::DisableTargets(disabled);
  return true;
}

}  // namespace landfall::kernels
