#include "kernels/isa.hpp"

#include <hwy/targets.h>

#include <atomic>
#include <cstdint>
#include <string_view>

namespace landfall::kernels {
namespace {

std::atomic<bool> scalar{false};
std::atomic<const char*> name{nullptr};  // of the best target that is not disabled; null: not asked yet

// Highway numbers targets so that a better one of the same architecture is a lower bit.
std::int64_t best_of(std::int64_t targets) {
  return targets & -targets;
}

// The machine's target of that name; 0: none.
std::int64_t find_target(std::string_view target_name) {
  static const std::int64_t all = hwy::SupportedTargets();
  for (std::int64_t rest = all; rest != 0; rest &= rest - 1)
    if (target_name == hwy::TargetName(best_of(rest))) return best_of(rest);
  return 0;
}

}  // namespace

bool scalar_selected() {
  return scalar.load(std::memory_order_relaxed);
}

const char* isa_name() {
  if (scalar_selected()) return "SCALAR";
  // Asking the processor takes tens of microseconds on a virtual one.
  const char* known = name.load(std::memory_order_relaxed);
  if (known == nullptr) {
    known = hwy::TargetName(best_of(hwy::SupportedTargets()));
    name.store(known, std::memory_order_relaxed);
  }
  return known;
}

bool select_isa(const char* target_name) {
  const std::string_view wanted = target_name == nullptr ? "" : target_name;
  std::int64_t disabled = 0;  // none: the best
  if (!wanted.empty() && wanted != "SCALAR") {
    const std::int64_t target = find_target(wanted);
    if (target == 0) return false;
    disabled = target - 1;
  }
  scalar = wanted == "SCALAR";
  hwy::DisableTargets(disabled);
  name = nullptr;
  return true;
}

}  // namespace landfall::kernels
