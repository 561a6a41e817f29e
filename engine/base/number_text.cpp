#include "engine/base/number_text.hpp"

#include <array>
#include <charconv>

namespace landfall {

std::string number_text(double value) {
  constexpr int digits = 10;
  std::array<char, 32> buffer{};
  const auto end =
      std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, std::chars_format::general, digits);
  return {buffer.data(), end.ptr};
}

std::string pose_text(const Pose2& pose) {
  return "(" + number_text(pose.x_m) + ", " + number_text(pose.y_m) + ", " + number_text(pose.theta_rad) +
         ")";
}

}  // namespace landfall
