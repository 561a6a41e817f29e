// Every executor of this build in turn.
#pragma once

#include <string>
#include <vector>

#include "engine/base/executor.hpp"

namespace landfall::testing {

// Uses one by name until it goes out of scope.
class UsedExecutor {
 public:
  explicit UsedExecutor(const std::string& name) { internal::select_executor(name.c_str()); }
  ~UsedExecutor() { internal::select_executor(nullptr); }
  UsedExecutor(const UsedExecutor&) = delete;
  UsedExecutor& operator=(const UsedExecutor&) = delete;
};

inline std::vector<std::string> executor_names() {
  std::vector<std::string> names;
  for (const internal::Executor* one : internal::executors()) names.emplace_back(one->name);
  return names;
}

}  // namespace landfall::testing
