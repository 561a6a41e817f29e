// What a CARMEN log says of its sensors, in PARAM lines and in the readings' own fields.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/io/place.hpp"
#include "engine/io/readers.hpp"
#include "engine/io/text.hpp"

namespace landfall::io {

// A SICK on a CARMEN robot where the log does not say otherwise.
struct CarmenLaser {
  std::string name;
  bool rear = false;
  double range_max_m = 80.0;
  std::optional<double> resolution_deg = std::nullopt;
  std::optional<double> offset_m =
      std::nullopt;  // ahead of the robot's centre (behind it for the rear laser)
  double side_offset_m = 0.0;
  std::optional<double> angular_offset_rad = std::nullopt;
  std::optional<Pose2> mount_of_poses =
      std::nullopt;  // from a line that gives the robot's pose and the laser's
};

// Where the laser sits: by PARAM, else as its poses show, else in the centre; a rear laser looks backwards.
Pose2 T_robot_laser(const CarmenLaser& laser);
// CARMEN's rule for logs without a resolution: a SICK's 180 degrees, or its 100-degree mode.
double guess_step_rad(int beams);

struct CarmenParams {
  CarmenLaser front{.name = "front_laser", .rear = false};
  CarmenLaser rear{.name = "rear_laser", .rear = true};
  double sonar_max_m = 5.0;
  std::vector<Pose2> T_robot_sonar;

  // A PARAM line after its first word. Names that do not matter here are passed over.
  void read(Words words, const Place& place);
};

// One sensor object for all scans of one geometry; the caller's replace the log's own, by name.
class CarmenSensors {
 public:
  explicit CarmenSensors(const SensorsByName& replacements) : replacements_(replacements) {}

  std::shared_ptr<const Sensor> fan(const FanOptions& fan, const Place& place);
  std::shared_ptr<const Sensor> sonar_ring(const std::vector<Pose2>& T_robot_sonar, double half_angle_rad,
                                           double range_max_m, const Place& place);
  // The caller's sensor of that name, or null.
  std::shared_ptr<const Sensor> replacement(const std::string& name, std::size_t beams,
                                            const Place& place) const;

 private:
  const SensorsByName& replacements_;
  std::map<std::string, std::map<std::vector<double>, std::shared_ptr<const Sensor>>> made_;
};

}  // namespace landfall::io
