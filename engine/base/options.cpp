#include "engine/base/options.hpp"

#include <cmath>
#include <cstdlib>
#include <mutex>
#include <string>

#include "engine/base/executor.hpp"
#include "engine/base/number_text.hpp"
#include "kernels/isa.hpp"
#include "landfall/error.hpp"

namespace landfall {
namespace internal {
namespace {

void require(bool holds, const char* option, double value, const char* expected) {
  if (!holds)
    throw Error(ErrorCode::invalid_argument,
                "option " + std::string(option) + " is " + number_text(value) + ", expected " + expected);
}

bool not_negative(double value) {
  return std::isfinite(value) && value >= 0.0;
}

}  // namespace

void validate(const SearchOptions& options) {
  constexpr int most_hypotheses = 1000;
  constexpr int most_threads = 1024;
  require(options.max_hypotheses >= 1 && options.max_hypotheses <= most_hypotheses, "max_hypotheses",
          options.max_hypotheses, "1 to 1000");
  require(not_negative(options.time_budget_s), "time_budget_s", options.time_budget_s, "0 (none) or seconds");
  require(options.threads >= 0 && options.threads <= most_threads, "threads", options.threads,
          "0 (all) to 1024");
  require(not_negative(options.robot_radius_m), "robot_radius_m", options.robot_radius_m, "0 or metres");
  require(not_negative(options.distinct_translation_m), "distinct_translation_m",
          options.distinct_translation_m, "0 or metres");
  require(not_negative(options.distinct_rotation_rad), "distinct_rotation_rad", options.distinct_rotation_rad,
          "0 or radians");
}

void validate_environment() {
  (void)active_isa();
  (void)active_executor();
}

}  // namespace internal

std::string active_isa() {
  static std::once_flag once;
  std::call_once(once, [] {
    const char* wanted = std::getenv("LANDFALL_ISA");
    if (!kernels::select_isa(wanted))
      throw Error(ErrorCode::unknown_name, "environment variable LANDFALL_ISA is \"" + std::string(wanted) +
                                               "\", which is no instruction set of this machine");
  });
  return kernels::isa_name();
}

std::string active_executor() {
  return internal::executor().name;
}

}  // namespace landfall
