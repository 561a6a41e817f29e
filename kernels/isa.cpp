#include "kernels/isa.hpp"

#include <hwy/targets.h>

#include <atomic>
#include <cstdint>
#include <string_view>

namespace landfall::kernels {
namespace {

std::atomic<bool> scalar{false};

// Highway numbers targets so that a better one of the same architecture is a lower bit.
std::int64_t best_of(std::int64_t targets) { return targets & -targets; }

}  // namespace

bool scalar_selected() { return scalar.load(std::memory_order_relaxed); }

const char* isa_name() {
  return scalar_selected() ? "SCALAR" : hwy::TargetName(best_of(hwy::SupportedTargets()));
}

bool select_isa(const char* name) {
  const std::string_view wanted = name == nullptr ? "" : name;
  scalar = false;
  hwy::DisableTargets(0);
  if (wanted.empty()) return true;
  if (wanted == "SCALAR") {
    scalar = true;
    return true;
  }
  const std::int64_t supported = hwy::SupportedTargets();
  for (std::int64_t rest = supported; rest != 0; rest &= rest - 1) {
    const std::int64_t target = best_of(rest);
    if (wanted != hwy::TargetName(target)) continue;
    hwy::DisableTargets(target - 1);
    return true;
  }
  return false;
}

}  // namespace landfall::kernels
