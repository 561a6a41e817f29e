#include "engine/sequence/odometry.hpp"

#include "engine/base/number_text.hpp"
#include "landfall/error.hpp"

namespace landfall::internal {

void check_odometry_noise(const std::string& function, const OdometryNoise& noise) {
  constexpr double most = 1000.0;  // beyond, odometry says nothing, and squares lose what scans say
  const auto check = [&](const char* field, double value) {
    if (!(value >= 0.0 && value <= most))
      throw Error(ErrorCode::invalid_argument, function + ": odometry." + field + " is " +
                                                   number_text(value) + ", expected 0 to " +
                                                   number_text(most));
  };
  check("translation_m", noise.translation_m);
  check("translation_relative", noise.translation_relative);
  check("translation_per_rad_m", noise.translation_per_rad_m);
  check("rotation_rad", noise.rotation_rad);
  check("rotation_per_m_rad", noise.rotation_per_m_rad);
  check("rotation_relative", noise.rotation_relative);
}

}  // namespace landfall::internal
