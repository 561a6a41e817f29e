#include "engine/methods/sdn/beam_bands.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace landfall::internal {
namespace {

constexpr double neighbour_rad = 0.06;
constexpr double neighbour_m = 0.05;
constexpr double widest_window_rad = 0.6;
constexpr double noise_sigmas = 2.5;
constexpr float infinity = std::numeric_limits<float>::infinity();

// A valid beam and how far its neighbours in the sensor's order are turned away; 0: there is none.
struct ValidBeam {
  std::size_t beam = 0;
  double range_m = 0.0;  // range_max_m without echo
  bool echo = false;
  double range_max_m = 0.0;
  double noise_m = 0.0;
  double to_next_rad = 0.0;
};

double turn_to_neighbour(const Beam& a, const Beam& b) {
  if (translation_distance(a.T_robot_beam, b.T_robot_beam) > neighbour_m) return 0.0;
  const double turn_rad = angle_distance(a.T_robot_beam.theta_rad, b.T_robot_beam.theta_rad);
  return turn_rad <= neighbour_rad ? turn_rad : 0.0;
}

std::vector<ValidBeam> valid_beams(const Scan& scan) {
  const Sensor& sensor = *scan.sensor;
  std::vector<ValidBeam> valid;
  for (std::size_t b = 0; b < scan.ranges_m.size(); ++b) {
    const Beam& beam = sensor.beams[b];
    const Reading reading = classify(beam, scan.ranges_m[b]);
    if (reading == Reading::invalid) continue;
    const double range_m = std::min<double>(scan.ranges_m[b], beam.range_max_m);
    valid.push_back({.beam = b,
                     .range_m = range_m,
                     .echo = reading == Reading::echo,
                     .range_max_m = beam.range_max_m,
                     .noise_m = sensor.range_noise_m + sensor.range_noise_relative * range_m});
  }
  for (std::size_t i = 0; i < valid.size(); ++i)  // the last one's next is the first: a full circle
    valid[i].to_next_rad =
        turn_to_neighbour(sensor.beams[valid[i].beam], sensor.beams[valid[(i + 1) % valid.size()].beam]);
  return valid;
}

// What the beams to one side of a beam see, up to an angle.
class Side {
 public:
  Side(const std::vector<ValidBeam>& valid, bool forwards) : valid_(valid), forwards_(forwards) {}

  void widen(std::size_t at, double window_rad, double& least_m, double& most_m) const {
    const double own_m = valid_[at].range_m;
    double turned_rad = 0.0;
    for (std::size_t steps = 0; steps < valid_.size(); ++steps) {
      const std::size_t next =
          forwards_ ? (at + 1) % valid_.size() : (at + valid_.size() - 1) % valid_.size();
      const double step_rad = valid_[forwards_ ? at : next].to_next_rad;
      if (step_rad == 0.0) {  // nobody sees what lies there: a wall at 45 degrees
        add(own_m - own_m * (window_rad - turned_rad), least_m, most_m);
        add(own_m + own_m * (window_rad - turned_rad), least_m, most_m);
        return;
      }
      if (turned_rad + step_rad > window_rad) {
        const double part = (window_rad - turned_rad) / step_rad;
        if (valid_[at].echo && valid_[next].echo)
          add(valid_[at].range_m + part * (valid_[next].range_m - valid_[at].range_m), least_m, most_m);
        return;
      }
      add(valid_[next].echo ? valid_[next].range_m : infinity, least_m, most_m);
      turned_rad += step_rad;
      at = next;
    }
  }

 private:
  static void add(double range_m, double& least_m, double& most_m) {
    least_m = std::min(least_m, range_m);
    most_m = std::max(most_m, range_m);
  }
  const std::vector<ValidBeam>& valid_;
  bool forwards_;
};

Band band_of(const std::vector<ValidBeam>& valid, std::size_t at, const FocusLevel& level,
             const BandOptions& options) {
  const ValidBeam& beam = valid[at];
  const double window_rad = std::min(
      widest_window_rad, options.region_share * (level.half_rad + std::atan2(level.half_m, beam.range_m)));
  double least_m = beam.range_m;
  double most_m = beam.echo ? beam.range_m : infinity;
  Side(valid, true).widen(at, window_rad, least_m, most_m);
  Side(valid, false).widen(at, window_rad, least_m, most_m);
  const double slack_m =
      options.region_share * level.half_m + noise_sigmas * beam.noise_m + options.map_noise_m;
  const double high_m = most_m + slack_m;
  return {.low_m = static_cast<float>(least_m - slack_m),
          .high_m = high_m >= beam.range_max_m ? infinity : static_cast<float>(high_m)};
}

}  // namespace

BeamBands::BeamBands(const Scan& scan, std::span<const FocusLevel> levels, const BandOptions& options) {
  const std::vector<ValidBeam> valid = valid_beams(scan);
  beams_.reserve(valid.size());
  for (const ValidBeam& beam : valid) beams_.push_back(beam.beam);
  bands_.reserve(levels.size() * valid.size());
  for (const FocusLevel& level : levels)
    for (std::size_t i = 0; i < valid.size(); ++i) bands_.push_back(band_of(valid, i, level, options));
}

}  // namespace landfall::internal
