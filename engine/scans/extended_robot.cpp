#include "landfall/extended_robot.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "engine/scans/turn_readings.hpp"
#include "landfall/error.hpp"

namespace landfall {
namespace {

[[noreturn]] void fail(const std::string& message) {
  throw Error(ErrorCode::invalid_argument, message);
}

// One beam's valid readings along the turn.
struct TurnReading {
  std::size_t scan;
  float range_m;  // infinite: no echo
};

std::vector<TurnReading> readings_of_beam(std::span<const Scan> turn, std::size_t beam) {
  std::vector<TurnReading> readings;
  for (std::size_t i = 0; i < turn.size(); ++i) {
    const float range_m = turn[i].ranges_m[beam];
    const Reading reading = classify(turn[i].sensor->beams[beam], range_m);
    if (reading == Reading::invalid) continue;
    readings.push_back(
        {.scan = i, .range_m = reading == Reading::echo ? range_m : std::numeric_limits<float>::infinity()});
  }
  return readings;
}

// So that on a full turn no run of equal readings spans the seam. False: all are equal.
bool begin_with_a_change(std::vector<TurnReading>& readings) {
  for (std::size_t i = 0; i < readings.size(); ++i) {
    const std::size_t before = (i + readings.size() - 1) % readings.size();
    if (readings[i].range_m == readings[before].range_m) continue;
    std::rotate(readings.begin(), readings.begin() + static_cast<std::ptrdiff_t>(i), readings.end());
    return true;
  }
  return false;
}

// The scans of a beam's local minima.
std::vector<std::size_t> local_minima(std::vector<TurnReading> readings, bool full_turn) {
  std::vector<std::size_t> minima;
  if (readings.empty() || (full_turn && !begin_with_a_change(readings))) return minima;
  const std::size_t count = readings.size();
  for (std::size_t first = 0, last = 0; first < count; first = last + 1) {
    last = first;
    while (last + 1 < count && readings[last + 1].range_m == readings[first].range_m) ++last;
    if (!full_turn && (first == 0 || last + 1 == count)) continue;
    const float before = readings[(first + count - 1) % count].range_m;
    const float after = readings[(last + 1) % count].range_m;
    if (!(readings[first].range_m < before) || !(readings[first].range_m < after)) continue;
    for (std::size_t middle = (first + last) / 2; middle <= (first + last + 1) / 2; ++middle)
      minima.push_back(readings[middle].scan);
  }
  return minima;
}

int mask_side(std::span<const float> mask) {
  const auto side = static_cast<int>(std::lround(std::sqrt(static_cast<double>(mask.size()))));
  if (side % 2 == 0 || static_cast<std::size_t>(side) * static_cast<std::size_t>(side) != mask.size())
    fail("mask: " + std::to_string(mask.size()) + " values, expected the square of an odd size");
  return side;
}

std::vector<float> convolved(const std::vector<float>& values, int width, int height,
                             std::span<const float> mask, int side) {
  std::vector<float> sums(values.size());
  const int half = side / 2;
  for (int dy = -half; dy <= half; ++dy) {
    for (int dx = -half; dx <= half; ++dx) {
      const float weight = mask.data()[(dy + half) * side + dx + half];
      if (weight == 0.0F) continue;
      for (int row = std::max(0, dy); row < std::min(height, height + dy); ++row)
        for (int col = std::max(0, dx); col < std::min(width, width + dx); ++col)
          sums[static_cast<std::size_t>(row) * static_cast<std::size_t>(width) +
               static_cast<std::size_t>(col)] +=
              weight * values[static_cast<std::size_t>(row - dy) * static_cast<std::size_t>(width) +
                              static_cast<std::size_t>(col - dx)];
    }
  }
  return sums;
}

}  // namespace

std::vector<Scan> keep_local_minima(std::span<const Scan> turn, bool full_turn) {
  internal::check_turn(turn);
  std::vector<Scan> kept(turn.begin(), turn.end());
  const std::size_t beams = turn.empty() ? 0 : turn[0].ranges_m.size();
  for (std::size_t beam = 0; beam < beams; ++beam) {
    const std::vector<std::size_t> minima = local_minima(readings_of_beam(turn, beam), full_turn);
    for (Scan& scan : kept) scan.ranges_m[beam] = std::numeric_limits<float>::quiet_NaN();
    for (const std::size_t scan : minima) kept[scan].ranges_m[beam] = turn[scan].ranges_m[beam];
  }
  return kept;
}

Scan merge_turn(std::span<const Scan> turn) {
  std::vector<Pose2> T_first_robot;
  for (std::size_t i = 0; i < turn.size(); ++i)
    T_first_robot.push_back(
        {0.0, 0.0,
         wrap_angle(2.0 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(turn.size()))});
  return merge(turn, T_first_robot, 0);
}

std::vector<float> raised_cosine_mask(int size) {
  if (size < 3 || size > 255 || size % 2 == 0)
    fail("raised cosine mask of size " + std::to_string(size) + ", expected an odd number from 3 to 255");
  const int half = size / 2;
  std::vector<float> mask;
  for (int y = -half; y <= half; ++y) {
    for (int x = -half; x <= half; ++x) {
      const double distance = std::hypot(x, y);
      mask.push_back(distance < half
                         ? static_cast<float>(0.5 + 0.5 * std::cos(std::numbers::pi * distance / half))
                         : 0.0F);
    }
  }
  return mask;
}

std::vector<float> blurred_map(const GridMap& grid, std::span<const float> mask, int times) {
  validate(grid);
  const int side = mask_side(mask);
  if (times < 0 || times > 8) fail("blurred map: " + std::to_string(times) + " times, expected 0 to 8");
  std::vector<float> values(grid.cells.size());
  std::transform(grid.cells.begin(), grid.cells.end(), values.begin(),
                 [](Occupancy cell) { return cell == Occupancy::occupied ? 1.0F : 0.0F; });
  for (int i = 0; i < times; ++i) values = convolved(values, grid.width_cells, grid.height_cells, mask, side);
  return values;
}

}  // namespace landfall
