// What SLAM takes.
#pragma once

#include "landfall/slam.hpp"

namespace landfall::internal {

// Throws Error{invalid_argument} that names the option, the value and what was expected.
void check(const SlamOptions& options);

}  // namespace landfall::internal
