// CARMEN text logs: a message a line, http://carmen.sourceforge.net/logger_playback.html. Both the
// lines of CARMEN's loggers since 2005 (ROBOTLASER, RAWLASER, SONAR with its own offsets) and the older
// FLASER and RLASER of most published logs.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>

#include "engine/io/carmen_line.hpp"
#include "engine/io/carmen_sensors.hpp"
#include "engine/io/readers.hpp"

namespace landfall::io {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double default_sonar_half_angle_rad = 7.5 * pi / 180.0;
constexpr double max_mount_m = 3.0;  // a laser is on its robot

// The configuration that ROBOTLASER and RAWLASER lines start with.
struct LaserConfig {
  double start_rad = 0.0;
  double step_rad = 0.0;
  double range_max_m = 0.0;
};

class CarmenReader {
 public:
  CarmenReader(const LogSource& source, const LoadLogOptions& options)
      : source_(source), sensors_(options.sensors) {}

  Log read() {
    Lines lines(source_.text);
    for (std::string_view text; lines.next(text);) {
      Words words(text);
      const std::string_view kind = words.next();
      const auto message =
          std::find_if(messages.begin(), messages.end(), [kind](const Message& m) { return m.kind == kind; });
      if (message == messages.end()) continue;
      CarmenLine line(kind, words, {source_.file, lines.number()});
      (this->*message->read)(line);
    }
    drop_raw_scans();
    for (const auto& [what, lines_of] : passed_over_)
      log_.warnings.push_back(to_string(lines_of.first) + ": " + what + ", " +
                              std::to_string(lines_of.count) + (lines_of.count == 1 ? " line" : " lines"));
    if (log_.scans.empty())
      fail_format({source_.file}, "", "no scan", "a FLASER, RLASER, ROBOTLASER, RAWLASER or SONAR line");
    return std::move(log_);
  }

 private:
  struct Message {
    std::string_view kind;
    void (CarmenReader::*read)(CarmenLine& line);
  };
  static const std::array<Message, 9> messages;

  void read_param(CarmenLine& line) { params_.read(line.rest(), line.place()); }
  void read_odometry(CarmenLine& line) { T_odom_robot_ = line.pose("x y theta"); }
  void read_front(CarmenLine& line) { read_laser(line, params_.front); }
  void read_rear(CarmenLine& line) { read_laser(line, params_.rear); }
  void read_robot_front(CarmenLine& line) { read_robot_laser(line, params_.front); }
  void read_robot_rear(CarmenLine& line) { read_robot_laser(line, params_.rear); }
  void read_raw_front(CarmenLine& line) { read_raw_laser(line, params_.front); }
  void read_raw_rear(CarmenLine& line) { read_raw_laser(line, params_.rear); }

  // n ranges, the laser's pose, the robot's odometry, time stamp.
  void read_laser(CarmenLine& line, const CarmenLaser& laser) {
    const int beams = line.count("number of readings");
    if (beams == 0) return pass_over(line.place(), laser.name + ": no readings");
    Scan scan;
    scan.ranges_m = line.ranges(beams, 7);
    const Pose2 T_map_laser = line.pose("x y theta");
    scan.T_odom_robot = line.pose("odom_x odom_y odom_theta");
    scan.stamp_s = line.stamp_s();
    scan.T_map_robot = T_map_laser * inverse(T_robot_laser(laser));
    const double step_rad = laser.resolution_deg ? *laser.resolution_deg * pi / 180.0 : guess_step_rad(beams);
    scan.sensor = fan(laser, beams, {-pi / 2.0, step_rad, laser.range_max_m}, line.place());
    log_.scans.push_back(std::move(scan));
    seen_with_pose_[laser.rear] = true;
  }

  static LaserConfig read_config(CarmenLine& line) {
    line.skip(1, "laser_type");
    LaserConfig config;
    config.start_rad = line.number("start_angle");
    line.skip(1, "field_of_view");
    config.step_rad = line.number("angular_resolution");
    config.range_max_m = line.number("maximum_range");
    line.skip(2, "accuracy remission_mode");
    return config;
  }

  // Configuration, ranges, remissions, the laser's pose, the robot's odometry, motion, time stamp.
  void read_robot_laser(CarmenLine& line, CarmenLaser& laser) {
    const LaserConfig config = read_config(line);
    const int beams = line.count("number of readings");
    if (beams == 0) return pass_over(line.place(), laser.name + ": no readings");
    Scan scan;
    scan.ranges_m = line.ranges(beams, -1);
    line.skip(line.count("number of remissions"), "remission");
    const Pose2 T_map_laser = line.pose("laser_pose");
    scan.T_odom_robot = line.pose("robot_pose");
    line.skip(5, "tv rv forward_safety_dist side_safety_dist turn_axis");
    scan.stamp_s = line.stamp_s();
    take_mount(laser, inverse(*scan.T_odom_robot) * T_map_laser);
    scan.T_map_robot = T_map_laser * inverse(T_robot_laser(laser));
    scan.sensor = fan(laser, beams, config, line.place());
    log_.scans.push_back(std::move(scan));
    seen_with_pose_[laser.rear] = true;
  }

  // Configuration, ranges, remissions, time stamp; the pose is the latest ODOM line's.
  void read_raw_laser(CarmenLine& line, const CarmenLaser& laser) {
    const LaserConfig config = read_config(line);
    const int beams = line.count("number of readings");
    if (beams == 0) return pass_over(line.place(), laser.name + ": no readings");
    Scan scan;
    scan.ranges_m = line.ranges(beams, -1);
    line.skip(line.count("number of remissions"), "remission");
    scan.stamp_s = line.stamp_s();
    scan.T_odom_robot = T_odom_robot_;
    scan.sensor = fan(laser, beams, config, line.place());
    raw_scans_.push_back({log_.scans.size(), laser.rear});
    log_.scans.push_back(std::move(scan));
  }

  // cone_angle n ranges, n offsets x y theta, time stamp; or n ranges, time stamp, with the offsets in
  // a PARAM line before. CARMEN prints the cone's angle with a point, the number without.
  void read_sonar(CarmenLine& line) {
    const bool with_offsets = line.peek().find('.') != std::string_view::npos;
    const double half_angle_rad =
        with_offsets ? 0.5 * line.number("cone_angle") : default_sonar_half_angle_rad;
    const int sonars = line.count("number of sonars");
    if (sonars == 0) return pass_over(line.place(), "SONAR: no readings");
    Scan scan;
    scan.ranges_m = line.ranges(sonars, -1);
    std::vector<Pose2> T_robot_sonar = params_.T_robot_sonar;
    if (with_offsets) {
      T_robot_sonar.clear();
      for (int i = 0; i < sonars; ++i) T_robot_sonar.push_back(line.pose("offset"));
    }
    scan.stamp_s = line.stamp_s();
    scan.T_odom_robot = T_odom_robot_;
    scan.sensor = sensors_.replacement("sonar", scan.ranges_m.size(), line.place());
    if (!scan.sensor && T_robot_sonar.size() != scan.ranges_m.size())
      return pass_over(line.place(),
                       "SONAR: the log does not say where its sonars are (no "
                       "robot_sonar_offsets for each), give a sensor 'sonar'");
    if (!scan.sensor)
      scan.sensor = sensors_.sonar_ring(T_robot_sonar, half_angle_rad, params_.sonar_max_m, line.place());
    log_.scans.push_back(std::move(scan));
  }

  std::shared_ptr<const Sensor> fan(const CarmenLaser& laser, int beams, const LaserConfig& config,
                                    const Place& place) {
    return sensors_.fan({.name = laser.name,
                         .beams = beams,
                         .first_rad = config.start_rad,
                         .step_rad = config.step_rad > 0.0 ? config.step_rad : guess_step_rad(beams),
                         .T_robot_sensor = T_robot_laser(laser),
                         .range_max_m = config.range_max_m > 0.0 ? config.range_max_m : laser.range_max_m},
                        place);
  }

  // The first line's two poses tell where the laser sits; later ones may differ by rounding, or because
  // the laser's poses alone were corrected.
  static void take_mount(CarmenLaser& laser, const Pose2& T_robot_laser) {
    if (laser.mount_of_poses) return;
    const bool on_robot = std::hypot(T_robot_laser.x_m, T_robot_laser.y_m) <= max_mount_m;
    laser.mount_of_poses = on_robot ? T_robot_laser : landfall::io::T_robot_laser(laser);
  }

  // CARMEN logs a laser's readings twice, raw and with the robot's pose: the latter are kept.
  void drop_raw_scans() {
    const bool any = std::any_of(raw_scans_.begin(), raw_scans_.end(),
                                 [this](const RawScan& raw) { return seen_with_pose_[raw.rear]; });
    if (!any) return;
    for (const RawScan& raw : raw_scans_)
      if (seen_with_pose_[raw.rear]) log_.scans[raw.index].sensor = nullptr;
    std::erase_if(log_.scans, [](const Scan& scan) { return scan.sensor == nullptr; });
    log_.warnings.push_back(source_.file + ": RAWLASER lines passed over: the log repeats them with poses");
  }

  void pass_over(const Place& place, const std::string& what) {
    ++passed_over_.try_emplace(what, PassedOver{.first = place}).first->second.count;
  }

  struct PassedOver {
    Place first;
    int count = 0;
  };
  struct RawScan {
    std::size_t index = 0;
    bool rear = false;
  };

  const LogSource& source_;
  CarmenParams params_;
  CarmenSensors sensors_;
  std::optional<Pose2> T_odom_robot_;
  Log log_;
  std::map<std::string, PassedOver> passed_over_;
  std::vector<RawScan> raw_scans_;
  std::array<bool, 2> seen_with_pose_{};  // front, rear
};

const std::array<CarmenReader::Message, 9> CarmenReader::messages = {{
    {"FLASER", &CarmenReader::read_front},
    {"RLASER", &CarmenReader::read_rear},
    {"ROBOTLASER1", &CarmenReader::read_robot_front},
    {"ROBOTLASER2", &CarmenReader::read_robot_rear},
    {"RAWLASER1", &CarmenReader::read_raw_front},
    {"RAWLASER2", &CarmenReader::read_raw_rear},
    {"ODOM", &CarmenReader::read_odometry},
    {"SONAR", &CarmenReader::read_sonar},
    {"PARAM", &CarmenReader::read_param},
}};

}  // namespace

Log read_carmen(const LogSource& source, const LoadLogOptions& options) {
  return CarmenReader(source, options).read();
}

}  // namespace landfall::io
