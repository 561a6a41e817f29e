// The scene over a grid's merged faces gives the range of the exact walk through the grid's cells.
//
// Rule for rays that graze: the scene computes in floats, so it may see a ray up to `shift_m` beside where
// it is. Its range must lie between those of the walks shifted to either side by that much; all but a few
// rays must agree with the walk itself.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "engine/to_raycast.hpp"
#include "grid_oracle.hpp"
#include "landfall/wall_map.hpp"
#include "raycast/scene.hpp"

namespace landfall {
namespace {

constexpr double tolerance_m = 1e-3;
constexpr double shift_m = 2e-5;
constexpr double range_max_m = 60.0;

struct Agreement {
  int rays = 0;
  int grazing = 0;  // beyond the tolerance, yet between the shifted walks
  int wrong = 0;
};

void compare(const GridMap& map, const Pose2& T_map_beam, double range_m, Agreement& agreement) {
  const auto walked_m = [&](double aside_m) {
    return std::min(testing::walked_range_m(map, T_map_beam, range_max_m, aside_m), range_max_m);
  };
  ++agreement.rays;
  range_m = std::min(range_m, range_max_m);
  const double at_m = walked_m(0.0);
  if (std::abs(range_m - at_m) <= tolerance_m) return;
  const auto [low_m, high_m] = std::minmax({at_m, walked_m(shift_m), walked_m(-shift_m)});
  const bool between = range_m >= low_m - tolerance_m && range_m <= high_m + tolerance_m;
  between ? ++agreement.grazing : ++agreement.wrong;
}

// Fans of beams from random free places.
Agreement compare_fans(const GridMap& map, int poses, std::mt19937& rng) {
  constexpr int beam_count = 90;
  Agreement agreement;
  const raycast::Scene scene(internal::to_raycast(to_walls(map)));
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  std::vector<raycast::Beam> beams;
  for (int b = 0; b < beam_count; ++b)
    beams.push_back(
        {.x_m = 0.0, .y_m = 0.0, .theta_rad = 0.07 * b, .half_angle_rad = 0.0, .range_max_m = range_max_m});
  std::vector<float> ranges_m(beams.size());
  for (int n = 0; n < poses; ++n) {
    const Pose2 T_map_robot =
        map.T_map_grid * Pose2{.x_m = uniform(rng) * map.width_cells * map.resolution_m,
                               .y_m = uniform(rng) * map.height_cells * map.resolution_m,
                               .theta_rad = uniform(rng) * 6.0};
    if (map.at(map.cell_of({.x_m = T_map_robot.x_m, .y_m = T_map_robot.y_m})) != Occupancy::free) continue;
    scene.cast_fans(std::vector{internal::to_raycast(T_map_robot)}, beams, ranges_m);
    for (std::size_t b = 0; b < beams.size(); ++b)
      compare(map, T_map_robot * Pose2{.x_m = 0.0, .y_m = 0.0, .theta_rad = beams[b].theta_rad}, ranges_m[b],
              agreement);
  }
  return agreement;
}

GridMap random_map(std::mt19937& rng, double occupied_share, const Pose2& T_map_grid) {
  std::uniform_int_distribution<int> size(1, 60);
  GridMap map{.width_cells = size(rng),
              .height_cells = size(rng),
              .resolution_m = 0.02 * size(rng),
              .T_map_grid = T_map_grid,
              .cells = {}};
  std::bernoulli_distribution occupied(occupied_share);
  for (int i = 0; i < map.width_cells * map.height_cells; ++i)
    map.cells.push_back(occupied(rng) ? Occupancy::occupied : Occupancy::free);
  return map;
}

TEST(SceneEqualsGridWalk, OnRandomMaps) {
  std::mt19937 rng(20'261'122);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  Agreement sum;
  for (int n = 0; n < 150; ++n) {
    const Pose2 T_map_grid{
        .x_m = 1e4 * uniform(rng), .y_m = 1e4 * uniform(rng), .theta_rad = n % 2 == 0 ? 0.0 : uniform(rng)};
    const double occupied_share = n % 3 == 0 ? 0.3 : 0.03;
    const Agreement agreement = compare_fans(random_map(rng, occupied_share, T_map_grid), 20, rng);
    sum.rays += agreement.rays;
    sum.grazing += agreement.grazing;
    sum.wrong += agreement.wrong;
  }
  EXPECT_GT(sum.rays, 100'000);
  EXPECT_EQ(sum.wrong, 0) << "of " << sum.rays;
  EXPECT_LE(sum.grazing, sum.rays / 1000) << "of " << sum.rays;
}

}  // namespace
}  // namespace landfall
