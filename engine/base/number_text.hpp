// Numbers as error messages show them: "0.07", not "0.070000".
#pragma once

#include <string>

#include "landfall/pose2.hpp"

namespace landfall {

// At most ten significant digits, without trailing zeros.
std::string number_text(double value);
// "(x, y, theta)".
std::string pose_text(const Pose2& pose);

}  // namespace landfall
