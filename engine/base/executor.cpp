#include "engine/base/executor.hpp"

#include <array>
#include <atomic>
#include <cstdlib>
#include <string>
#include <string_view>

#include "landfall/error.hpp"

namespace landfall::internal {
namespace {

#if defined(LANDFALL_PLAIN_THREADS)
constexpr std::array table{&plain_threads_executor};
#elif defined(LANDFALL_OPENMP)
constexpr std::array table{&tbb_executor, &openmp_executor};
#else
constexpr std::array table{&tbb_executor};
#endif

std::atomic<const Executor*> used{nullptr};  // null: ask the environment

const Executor* find(std::string_view name) {
  for (const Executor* one : table)
    if (name == one->name) return one;
  return nullptr;
}

[[noreturn]] void refuse(const std::string& name) {
  std::string known;
  for (const Executor* one : table) known += (known.empty() ? "" : " or ") + std::string(one->name);
  throw Error(ErrorCode::unknown_name,
              "environment variable LANDFALL_EXECUTOR is \"" + name + "\", expected " + known +
                  (name == "openmp" ? ": this build is without OpenMP (CMake option LANDFALL_OPENMP)" : ""));
}

const Executor* of_environment() {
  const char* wanted = std::getenv("LANDFALL_EXECUTOR");
  if (wanted == nullptr || *wanted == '\0') return table.front();
  const Executor* found = find(wanted);
  if (found == nullptr) refuse(wanted);
  return found;
}

}  // namespace

std::span<const Executor* const> executors() {
  return table;
}

const Executor& executor() {
  const Executor* known = used.load(std::memory_order_relaxed);
  if (known == nullptr) {
    known = of_environment();
    used.store(known, std::memory_order_relaxed);
  }
  return *known;
}

bool select_executor(const char* name) {
  const std::string_view wanted = name == nullptr ? "" : name;
  const Executor* found = find(wanted);
  if (!wanted.empty() && found == nullptr) return false;
  used.store(found, std::memory_order_relaxed);
  return true;
}

}  // namespace landfall::internal
