// Random questions for search(): a map, a prior, a scan and options that belong together, from a seed.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <numbers>
#include <vector>

#include "engine/base/counter_rng.hpp"
#include "landfall/search.hpp"
#include "landfall/simulate.hpp"

namespace landfall::testing {

struct World {
  PreparedMap map;
  PosePrior prior;
  Scan scan;
  SearchOptions options;
};

// Draws what a World is made of.
class Dice {
 public:
  explicit Dice(std::uint64_t seed, std::uint32_t stream = 0) : rng_(seed, stream) {}

  int between(int low, int high) {
    return low + static_cast<int>(rng_.below(static_cast<std::uint32_t>(high - low + 1)));
  }
  double between(double low, double high) { return low + (high - low) * rng_.uniform(); }
  bool chance(double probability) { return rng_.uniform() < probability; }
  template <class T>
  T one_of(std::initializer_list<T> values) {
    return values.begin()[rng_.below(static_cast<std::uint32_t>(values.size()))];
  }

 private:
  internal::CounterRng rng_;
};

// Walls of rooms, specks of clutter, patches that nobody has seen.
inline GridMap random_map(Dice& dice, int least_side_cells, int most_side_cells) {
  GridMap map{.width_cells = dice.between(least_side_cells, most_side_cells),
              .height_cells = dice.between(least_side_cells, most_side_cells),
              .resolution_m = dice.one_of({0.05, 0.1, 0.3, 1.0}),
              .T_map_grid = {dice.between(-50.0, 50.0), dice.between(-50.0, 50.0), 0.0},
              .cells = {}};
  if (dice.chance(0.5)) map.T_map_grid.theta_rad = dice.between(-3.0, 3.0);
  map.cells.assign(static_cast<std::size_t>(map.width_cells) * static_cast<std::size_t>(map.height_cells),
                   Occupancy::free);
  const auto draw_box = [&](Occupancy what, bool filled) {
    const auto [left, right] =
        std::minmax({dice.between(0, map.width_cells - 1), dice.between(0, map.width_cells - 1)});
    const auto [low, high] =
        std::minmax({dice.between(0, map.height_cells - 1), dice.between(0, map.height_cells - 1)});
    for (int row = low; row <= high; ++row)
      for (int col = left; col <= right; ++col)
        if (filled || row == low || row == high || col == left || col == right)
          map.cells[map.index({col, row})] = what;
  };
  for (int i = dice.between(0, 6); i > 0; --i) draw_box(Occupancy::occupied, false);
  for (int i = dice.between(0, 2); i > 0; --i) draw_box(Occupancy::unknown, true);
  const double clutter = dice.one_of({0.0, 0.0, 0.01, 0.05, 0.3});
  for (Occupancy& cell : map.cells)
    if (dice.chance(clutter)) cell = dice.chance(0.8) ? Occupancy::occupied : Occupancy::unknown;
  return map;
}

inline Pose2 random_pose(Dice& dice, const GridMap& map) {
  const Point2 p_map =
      map.center_of({dice.between(0, map.width_cells - 1), dice.between(0, map.height_cells - 1)});
  return {p_map.x_m + dice.between(-0.5, 0.5) * map.resolution_m,
          p_map.y_m + dice.between(-0.5, 0.5) * map.resolution_m, dice.between(-3.1, 3.1)};
}

inline Sensor random_sensor(Dice& dice, const GridMap& map, int most_beams) {
  const int beams = dice.chance(0.3) ? dice.between(1, 8) : dice.between(1, most_beams);
  Sensor sensor =
      make_fan({.beams = beams,
                .first_rad = -2.0,
                .step_rad = dice.between(0.3, 1.0) * 2.0 * std::numbers::pi / beams,
                .T_robot_sensor = {dice.between(-0.3, 0.3), dice.between(-0.3, 0.3), dice.between(-3.0, 3.0)},
                .range_max_m = map.resolution_m * dice.between(3, 150)});
  if (dice.chance(0.2))
    for (Beam& beam : sensor.beams) beam.T_robot_beam.x_m += dice.between(-1.0, 1.0);
  return sensor;
}

// What the map shows from a random pose, or ranges of any length; some readings invalid or without echo.
inline Scan random_scan(Dice& dice, const PreparedMap& map, int most_beams) {
  const auto sensor = std::make_shared<const Sensor>(random_sensor(dice, map.grid(), most_beams));
  const std::vector<Pose2> T_map_robot{random_pose(dice, map.grid())};
  Scan scan = simulate(map, sensor, T_map_robot, {.noise = dice.chance(0.5), .seed = 1}).front();
  const double made_up = dice.one_of({0.0, 0.1, 1.0});
  const double reach_m = map.grid().resolution_m * dice.one_of({2.0, 20.0, 100.0, 400.0});
  const double broken = dice.one_of({0.0, 0.1, 0.5});
  for (float& range_m : scan.ranges_m) {
    if (dice.chance(made_up)) range_m = static_cast<float>(dice.between(0.0, reach_m));
    if (dice.chance(broken))
      range_m =
          dice.chance(0.5) ? std::numeric_limits<float>::quiet_NaN() : std::numeric_limits<float>::infinity();
  }
  return scan;
}

inline Gaussian random_gaussian(Dice& dice, const GridMap& map) {
  const double sigma_m[] = {map.resolution_m * dice.between(0.0, 4.0),
                            map.resolution_m * dice.between(0.0, 4.0)};
  const double sigma_rad = dice.between(0.0, 0.5);
  const double correlation = dice.between(-0.9, 0.9);
  const double xy = correlation * sigma_m[0] * sigma_m[1];
  return {.T_map_robot = random_pose(dice, map),
          .covariance = {sigma_m[0] * sigma_m[0], xy, 0.0, xy, sigma_m[1] * sigma_m[1], 0.0, 0.0, 0.0,
                         sigma_rad * sigma_rad}};
}

inline Region random_region(Dice& dice, const GridMap& map) {
  Region region{.polygon_map = {},
                .theta_rad = dice.between(-4.0, 4.0),
                .half_theta_rad = dice.one_of({0.3, 2.0, 7.0})};
  for (int i = dice.between(3, 6); i > 0; --i) {
    const Pose2 corner = random_pose(dice, map);
    region.polygon_map.push_back({corner.x_m, corner.y_m});
  }
  return region;
}

inline PosePrior random_plain_prior(Dice& dice, const GridMap& map) {
  const double size_m = map.resolution_m * map.width_cells;
  switch (dice.between(0, 6)) {
    case 0:
      return {Window{random_pose(dice, map), dice.between(0.0, size_m), dice.between(0.0, size_m),
                     dice.between(0.0, 3.2)}};
    case 1:
      return {random_gaussian(dice, map)};
    case 2:
      return {random_region(dice, map)};
    case 3: {
      Beacons beacons;
      for (int i = dice.between(1, 4); i > 0; --i) {
        const Pose2 center = random_pose(dice, map);
        beacons.discs.push_back({{center.x_m, center.y_m}, dice.between(0.0, 0.3 * size_m)});
      }
      return {beacons};
    }
    case 4: {
      CandidatePoses candidates;
      for (int i = dice.between(1, 40); i > 0; --i) candidates.T_map_robot.push_back(random_pose(dice, map));
      return {candidates};
    }
    default:
      return {Anywhere{}};
  }
}

inline PosePrior random_prior(Dice& dice, const GridMap& map) {
  if (dice.chance(0.8)) return random_plain_prior(dice, map);
  Mixture mixture;
  for (int i = dice.between(1, 3); i > 0; --i) {
    mixture.weights.push_back(dice.between(0.1, 3.0));
    mixture.components.push_back(random_plain_prior(dice, map));
  }
  return {mixture};
}

inline SearchOptions random_options(Dice& dice, const GridMap& map) {
  return {.method = "auto",
          .translation_step_m = map.resolution_m * dice.one_of({1, 1, 2, 3}),
          .rotation_step_rad = dice.one_of({0.01, 0.05, 0.2, 0.7, 1.3, 2.2, 2.0 * std::numbers::pi}),
          .max_hypotheses = dice.between(1, 10),
          .robot_radius_m = dice.chance(0.2) ? map.resolution_m * dice.between(0.0, 3.0) : 0.0,
          .distinct_translation_m = map.resolution_m * dice.between(0.0, 10.0),
          .distinct_rotation_rad = dice.between(0.0, 0.5)};
}

inline World small_world(std::uint64_t seed) {
  Dice dice(seed);
  const PreparedMap map(random_map(dice, 1, 40),
                        {.unknown_value = dice.one_of<std::uint8_t>({0, 0, 30}), .name = {}});
  return {.map = map,
          .prior = random_prior(dice, map.grid()),
          .scan = random_scan(dice, map, 600),
          .options = random_options(dice, map.grid())};
}

// So many poses that branch and bound does not merely score them all.
inline World large_world(std::uint64_t seed) {
  Dice dice(seed, 1);
  const bool fine_rotation = dice.chance(0.5);
  const PreparedMap map(fine_rotation ? random_map(dice, 40, 100) : random_map(dice, 200, 300));
  World world{.map = map,
              .prior = {Anywhere{}},
              .scan = random_scan(dice, map, dice.chance(0.1) ? 600 : 60),
              .options = random_options(dice, map.grid())};
  world.options.translation_step_m = map.grid().resolution_m * dice.one_of({1, 1, 1, 2});
  world.options.rotation_step_rad =
      2.0 * std::numbers::pi / (fine_rotation ? 720.0 : dice.one_of({3.0, 5.0, 9.0, 24.0}));
  if (dice.chance(0.2)) {
    world.prior = {Mixture{{1.0, 2.0}, {{Anywhere{}}, random_plain_prior(dice, map.grid())}}};
  } else if (dice.chance(0.2)) {
    const double size_m = map.grid().resolution_m * map.grid().width_cells;
    world.prior = {Window{random_pose(dice, map.grid()), size_m, size_m, dice.between(1.5, 3.2)}};
  }
  return world;
}

// Few beams, most of them so short that many coarse headings are bounded together, some so long that these
// headings carry their end points over half the map.
inline World coarse_world(std::uint64_t seed) {
  Dice dice(seed, 2);
  const PreparedMap map(random_map(dice, 200, 300));
  const auto sensor = std::make_shared<const Sensor>(make_fan({.beams = dice.one_of({3, 12, 40}),
                                                               .first_rad = -2.0,
                                                               .step_rad = dice.between(0.1, 1.0),
                                                               .range_max_m = 1e3}));
  Scan scan{.sensor = sensor};
  const double short_cells = dice.one_of({0.3, 2.0});
  const double share_of_short = dice.one_of({0.5, 0.97});
  for (std::size_t i = 0; i < sensor->beams.size(); ++i) {
    const double range_cells =
        dice.chance(share_of_short) ? dice.between(0.1, short_cells) : dice.between(2.0, 200.0);
    scan.ranges_m.push_back(static_cast<float>(range_cells * map.grid().resolution_m));
  }
  World world{.map = map, .prior = {Anywhere{}}, .scan = scan, .options = {}};
  world.options.rotation_step_rad = 2.0 * std::numbers::pi / dice.between(3, 24);
  return world;
}

}  // namespace landfall::testing
