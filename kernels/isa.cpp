#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/isa.cpp"
#include <hwy/foreach_target.h>
// foreach_target comes before highway.h
#include <hwy/highway.h>

#include <atomic>
#include <cstdint>
#include <string_view>

#include "kernels/isa.hpp"

HWY_BEFORE_NAMESPACE();
namespace landfall::kernels {
namespace HWY_NAMESPACE {

// Highway's own fallback is compiled as one lane (HWY_SCALAR) where its compiler cannot do EMU128. It has the
// latter's name here: SCALAR is our plain twins.
const char* DispatchedName() {
  return HWY_TARGET == HWY_SCALAR ? "EMU128" : hwy::TargetName(HWY_TARGET);
}

}  // namespace HWY_NAMESPACE
}  // namespace landfall::kernels
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace landfall::kernels {
namespace {

std::atomic<bool> scalar{false};

HWY_EXPORT(DispatchedName);

// The target of that name that the machine has and kernels were compiled for; 0: none. Highway numbers
// targets so that a better one of the same architecture is a lower bit.
std::int64_t find_target(std::string_view target_name) {
  static const std::int64_t all = hwy::SupportedTargets() & (HWY_TARGETS | HWY_EMU128);
  for (std::int64_t rest = all; rest != 0; rest &= rest - 1)
    if (target_name == hwy::TargetName(rest & -rest)) return rest & -rest;
  return 0;
}

}  // namespace

bool scalar_selected() {
  return scalar.load(std::memory_order_relaxed);
}

// Asked the way the kernels are called: SupportedTargets() would answer from the mask, but leaves the best
// target chosen for the next kernel, disabled or not (Highway 1.0.3).
const char* isa_name() {
  return scalar_selected() ? "SCALAR" : HWY_DYNAMIC_DISPATCH(DispatchedName)();
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
  return true;
}

}  // namespace landfall::kernels
#endif
