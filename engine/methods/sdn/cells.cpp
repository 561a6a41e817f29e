#include "engine/methods/sdn/cells.hpp"

#include <cmath>

namespace landfall::internal {
namespace {

// One in so many mappings stays in the middle of the region that it comes from: one that was copied from the
// right place is then right all the way down.
constexpr std::uint32_t middle_one_in = 4;
// So many tests in a row within tolerance at the finest level, and a cell counts as focused: one is passed by
// chance from a few centimetres off, which would be averaged in.
constexpr std::uint8_t focused_after = 3;

double between_plus_minus(double half, CounterRng& rng) {
  return half * (2.0 * rng.uniform() - 1.0);
}

Pose2 moved_within(const Pose2& pose, const FocusLevel& box, CounterRng& rng) {
  const double x_m = pose.x_m + between_plus_minus(box.half_m, rng);
  const double y_m = pose.y_m + between_plus_minus(box.half_m, rng);
  return {x_m, y_m, wrap_angle(pose.theta_rad + between_plus_minus(box.half_rad, rng))};
}

bool holds(const FocusLevel& region, const Pose2& center, const Pose2& pose) {
  return std::abs(pose.x_m - center.x_m) <= region.half_m &&
         std::abs(pose.y_m - center.y_m) <= region.half_m &&
         angle_distance(pose.theta_rad, center.theta_rad) <= region.half_rad;
}

}  // namespace

Cells::Cells(std::size_t count, std::span<const FocusLevel> levels)
    : levels_(levels),
      level_(count),
      passed_(count),
      path_(count * levels.size()),
      mappings_(count),
      next_(count) {}

void Cells::place(std::size_t cell, const Pose2& T_map_robot, std::size_t level) {
  passed_[cell] = 0;
  for (std::size_t above = 0; above <= level; ++above) {
    level_[cell] = static_cast<std::uint8_t>(above);
    path_[index(cell)] = T_map_robot;
  }
}

void Cells::copy(std::size_t cell, const Pose2& T_map_robot, CounterRng& rng) {
  place(cell, rng.below(middle_one_in) == 0 ? T_map_robot : moved_within(T_map_robot, levels_.front(), rng));
}

void Cells::pass(std::size_t cell, const Mapping& polled, CounterRng& rng) {
  const bool at_finest = level_[cell] == finest();
  if (at_finest && passed_[cell] < focused_after) ++passed_[cell];
  next_[cell] = {.T_map_robot = T_map_robot(cell),
                 .active = true,
                 .focused = passed_[cell] >= focused_after,
                 .level = level_[cell]};
  if (at_finest) return;
  const FocusLevel& here = levels_[level_[cell]];
  const FocusLevel& below = levels_[level_[cell] + 1U];
  Pose2 T_map_part = T_map_robot(cell);
  if (polled.active && polled.level > level_[cell] && holds(here, T_map_part, polled.T_map_robot)) {
    T_map_part = moved_within(polled.T_map_robot, levels_[polled.level], rng);
  } else if (rng.below(middle_one_in) != 0) {
    T_map_part = moved_within(
        T_map_part, {.half_m = here.half_m - below.half_m, .half_rad = here.half_rad - below.half_rad}, rng);
  }
  ++level_[cell];
  path_[index(cell)] = T_map_part;
}

void Cells::fail(std::size_t cell, std::size_t levels) {
  const bool active = level_[cell] >= levels;
  passed_[cell] = 0;
  level_[cell] = static_cast<std::uint8_t>(active ? level_[cell] - levels : 0);
  next_[cell] = {.T_map_robot = T_map_robot(cell), .active = active, .focused = false, .level = level_[cell]};
}

}  // namespace landfall::internal
