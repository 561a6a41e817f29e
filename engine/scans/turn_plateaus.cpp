#include "engine/scans/turn_plateaus.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace landfall::internal {
namespace {

constexpr double largest_gap_steps = 1.01;  // within a plateau, and from its end to what lies beyond it
constexpr double largest_end_steps = 0.25;  // that an end may lie beyond its last reading, where nothing does
constexpr double same_point_half_angles = 0.8;
// The shortest of a plateau's readings is, of some twenty, so much below their mean.
constexpr double shortest_sigmas = 1.5;
constexpr std::size_t few = 3;

struct Plateau {
  std::size_t first = 0;  // clockwise end
  std::size_t last = 0;
  std::vector<std::size_t> members{};
  double mean_m = 0.0;
  std::optional<std::size_t> before{};  // the readings beyond its ends
  std::optional<std::size_t> after{};
};

class PlateauFinder {
 public:
  PlateauFinder(std::span<const TurnReading> readings, const PlateauRule& rule)
      : readings_(readings), rule_(rule), found_{.taken = std::vector<bool>(readings.size())} {}

  TurnPlateaus run() {
    for (const std::size_t shortest : by_distance()) {
      if (found_.taken[shortest] || !std::isfinite(readings_[shortest].foot_m)) continue;
      tolerance_m_ = rule_.equal_sigmas * readings_[shortest].noise_m + rule_.slack_m;
      const Plateau plateau = grow(shortest);
      if (!is_plateau(plateau, readings_[shortest].half_angle_rad)) continue;
      for (const std::size_t i : plateau.members) found_.taken[i] = true;
      add_points(plateau, readings_[shortest].half_angle_rad);
    }
    return std::move(found_);
  }

 private:
  [[nodiscard]] std::vector<std::size_t> by_distance() const {
    std::vector<std::size_t> order(readings_.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return readings_[a].foot_m < readings_[b].foot_m; });
    return order;
  }

  [[nodiscard]] Plateau grow(std::size_t shortest) const {
    Plateau plateau{.first = shortest, .last = shortest, .members = {shortest}};
    plateau.mean_m = readings_[shortest].foot_m + shortest_sigmas * readings_[shortest].noise_m;
    plateau.before = grow_end(plateau, plateau.first, readings_.size() - 1);
    plateau.after = grow_end(plateau, plateau.last, 1);
    return plateau;
  }

  // From `end` on in steps of `step`, over one reading that does not belong at most; the first beyond.
  std::optional<std::size_t> grow_end(Plateau& plateau, std::size_t& end, std::size_t step) const {
    const std::size_t start = end;
    std::optional<std::size_t> beyond;
    for (std::size_t next = (end + step) % readings_.size(); next != start;
         next = (next + step) % readings_.size()) {
      if (!found_.taken[next] && belongs(plateau, next, end)) {
        plateau.members.push_back(next);
        if (plateau.members.size() > few) plateau.mean_m = mean_m(plateau.members);
        end = next;
        beyond.reset();
        continue;
      }
      if (beyond || found_.taken[next]) return beyond ? beyond : next;
      beyond = next;
    }
    return beyond;
  }

  [[nodiscard]] bool belongs(const Plateau& plateau, std::size_t next, std::size_t end) const {
    const double gap_rad = angle_distance(readings_[next].bearing_rad, readings_[end].bearing_rad);
    return std::abs(readings_[next].foot_m - plateau.mean_m) <= tolerance_m_ &&
           gap_rad < largest_gap_steps * rule_.turn_step_rad;
  }

  [[nodiscard]] double mean_m(const std::vector<std::size_t>& members) const {
    double sum_m = 0.0;
    for (const std::size_t i : members) sum_m += readings_[i].foot_m;
    return sum_m / static_cast<double>(members.size());
  }

  [[nodiscard]] bool is_plateau(const Plateau& plateau, double half_angle_rad) const {
    const double width_rad =
        positive_angle(readings_[plateau.last].bearing_rad - readings_[plateau.first].bearing_rad);
    if (plateau.members.size() < few || width_rad < half_angle_rad || half_angle_rad == 0.0) return false;
    std::size_t between = 0;
    for (std::size_t i = plateau.first;; i = (i + 1) % readings_.size()) {
      if (!found_.taken[i]) {
        if (readings_[i].foot_m < plateau.mean_m - tolerance_m_) return false;
        ++between;
      }
      if (i == plateau.last) break;
    }
    return static_cast<double>(plateau.members.size()) >= rule_.least_density * static_cast<double>(between);
  }

  // Half a gap beyond the end's last reading, where the next one is longer; none where it is not.
  [[nodiscard]] std::optional<double> open_end_rad(const Plateau& plateau, std::size_t end,
                                                   const std::optional<std::size_t>& beyond) const {
    if (!beyond || readings_[*beyond].foot_m <= plateau.mean_m) return std::nullopt;
    const double gap_rad = wrap_angle(readings_[*beyond].bearing_rad - readings_[end].bearing_rad);
    const double most_rad = largest_end_steps * rule_.turn_step_rad;
    const bool next_is_near = std::abs(gap_rad) < largest_gap_steps * rule_.turn_step_rad;
    return readings_[end].bearing_rad + (next_is_near ? 0.5 * gap_rad : std::copysign(most_rad, gap_rad));
  }

  void add_points(const Plateau& plateau, double half_angle_rad) {
    std::optional<double> left = open_end_rad(plateau, plateau.last, plateau.after);
    std::optional<double> right = open_end_rad(plateau, plateau.first, plateau.before);
    if (left) *left -= half_angle_rad;
    if (right) *right += half_angle_rad;
    if (left && right && angle_distance(*left, *right) < same_point_half_angles * half_angle_rad) {
      *right += 0.5 * wrap_angle(*left - *right);
      left.reset();
    }
    for (const std::optional<double>& bearing_rad : {right, left})
      if (bearing_rad)
        found_.points.push_back({.bearing_rad = positive_angle(*bearing_rad), .distance_m = plateau.mean_m});
  }

  std::span<const TurnReading> readings_;
  PlateauRule rule_;
  TurnPlateaus found_;
  double tolerance_m_ = 0.0;
};

}  // namespace

TurnPlateaus find_plateaus(std::span<const TurnReading> readings, const PlateauRule& rule) {
  return PlateauFinder(readings, rule).run();
}

}  // namespace landfall::internal
