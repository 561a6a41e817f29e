#include "bench/ray_places.hpp"

#include <cmath>
#include <cstdio>
#include <numbers>
#include <random>
#include <utility>

#include "bench/office.hpp"
#include "bench/places.hpp"
#include "engine/maps/to_raycast.hpp"
#include "landfall/io.hpp"
#include "raycast/segment_tree.hpp"
#include "tests/data_folder.hpp"
#include "tests/raycast/agreement.hpp"
#include "tests/raycast/grid_oracle.hpp"
#include "tests/raycast/wall_oracle.hpp"

namespace landfall::bench {
namespace {

constexpr double pi = std::numbers::pi;
constexpr int pose_count = 500;

RayPlace make_place(std::string name, GridMap grid, const std::optional<WallMap>& plan) {
  RayPlace place;
  place.name = std::move(name);
  place.grid = std::move(grid);
  place.has_own_walls = plan.has_value();
  place.walls = internal::to_raycast(plan ? *plan : to_walls(place.grid));
  place.embree = std::make_shared<const raycast::WallTrace>(place.walls);
  for (const Pose2& pose : random_free_poses(place.grid, pose_count))
    place.poses.push_back(internal::to_raycast(pose));
  if (plan) {
    place.scene = std::make_shared<const raycast::Scene>(place.walls);
    return place;
  }
  const raycast::PlacedGrid placed = internal::to_raycast(place.grid);
  place.scene = std::make_shared<const raycast::Scene>(placed, [walls = place.walls] { return walls; });
  place.distance_walk = std::make_shared<const raycast::DistanceWalk>(placed);
  return place;
}

double oracle_m(const RayPlace& place, const raycast::Pose& ray, double shift_m) {
  return place.has_own_walls
             ? testing::crossed_range_m(place.walls, ray, range_max_m, shift_m)
             : testing::walked_range_m(place.grid, {ray.x_m, ray.y_m, ray.theta_rad}, range_max_m, shift_m);
}

bool holds(const testing::Agreement& agreement, const RayPlace& place, const char* what) {
  if (!agreement.holds())
    std::fprintf(stderr, "%s: %s: %d of %d rays differ from the oracle, %d graze\n", place.name.c_str(), what,
                 agreement.wrong, agreement.rays, agreement.grazing);
  return agreement.holds();
}

template <typename Caster>
bool fans_agree(const RayPlace& place, const char* what, const Caster& caster) {
  const std::vector<raycast::Beam> beams = fan(180, pi / 180.0, 0.0);
  std::vector<float> ranges_m(beams.size());
  testing::Agreement agreement;
  for (std::size_t p = 0; p < place.poses.size(); p += 10) {
    const raycast::Pose& pose = place.poses[p];
    caster.cast_fans({&pose, 1}, beams, ranges_m);
    for (std::size_t b = 0; b < beams.size(); ++b)
      agreement.add(ranges_m[b], range_max_m, [&](double shift_m) {
        return oracle_m(place, {pose.x_m, pose.y_m, pose.theta_rad + beams[b].theta_rad}, shift_m);
      });
  }
  return holds(agreement, place, what);
}

template <typename Cast>
bool rays_agree(const RayPlace& place, const char* what, const Cast& cast) {
  const std::vector<raycast::Ray> all = scattered_rays(place);
  const std::span<const raycast::Ray> rays = std::span(all).first(5000);
  std::vector<float> ranges_m(rays.size());
  cast(rays, ranges_m);
  testing::Agreement agreement;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const raycast::Pose ray{rays[i].x_m, rays[i].y_m, std::atan2(rays[i].dy, rays[i].dx)};
    agreement.add(ranges_m[i], range_max_m, [&](double shift_m) { return oracle_m(place, ray, shift_m); });
  }
  return holds(agreement, place, what);
}

template <typename Caster>
bool agrees(const RayPlace& place, const char* what, const Caster& caster) {
  return fans_agree(place, what, caster) &&
         rays_agree(place, what, [&](auto rays, auto& ranges_m) { caster.cast_rays(rays, ranges_m); });
}

// With the nearest of all walls, one by one.
bool cones_agree(const RayPlace& place) {
  const std::vector<raycast::Beam> cones = ring_of_cones();
  std::vector<float> ranges_m(cones.size());
  testing::Agreement agreement;
  for (std::size_t p = 0; p < place.poses.size(); p += 50) {
    const raycast::Pose& pose = place.poses[p];
    place.scene->cast_fans({&pose, 1}, cones, ranges_m);
    for (std::size_t b = 0; b < cones.size(); ++b)
      agreement.add(ranges_m[b], range_max_m, [&](double shift_m) {
        const double theta_rad = pose.theta_rad + cones[b].theta_rad;
        return raycast::nearest_in_cone(place.walls, {.x_m = pose.x_m - shift_m * std::sin(theta_rad),
                                                      .y_m = pose.y_m + shift_m * std::cos(theta_rad),
                                                      .theta_rad = theta_rad,
                                                      .half_angle_rad = cones[b].half_angle_rad,
                                                      .range_max_m = range_max_m});
      });
  }
  return holds(agreement, place, "cones");
}

}  // namespace

std::vector<raycast::Beam> fan(int count, double step_rad, double half_angle_rad) {
  std::vector<raycast::Beam> beams;
  beams.reserve(static_cast<std::size_t>(count));
  for (int b = 0; b < count; ++b)
    beams.push_back({.x_m = 0.0,
                     .y_m = 0.0,
                     .theta_rad = b * step_rad,
                     .half_angle_rad = half_angle_rad,
                     .range_max_m = range_max_m});
  return beams;
}

std::vector<raycast::Beam> ring_of_cones() {
  return fan(24, pi / 12.0, pi / 30.0);
}

std::vector<raycast::Ray> scattered_rays(const RayPlace& place) {
  std::mt19937 rng(2);
  std::uniform_real_distribution<double> angle_rad(-pi, pi);
  std::uniform_int_distribution<std::size_t> pose(0, place.poses.size() - 1);
  std::vector<raycast::Ray> rays;
  for (int i = 0; i < 180 * pose_count; ++i) {
    const raycast::Pose& from = place.poses[pose(rng)];
    const double theta_rad = angle_rad(rng);
    rays.push_back({.x_m = from.x_m,
                    .y_m = from.y_m,
                    .dx = static_cast<float>(std::cos(theta_rad)),
                    .dy = static_cast<float>(std::sin(theta_rad)),
                    .range_max_m = static_cast<float>(range_max_m)});
  }
  return rays;
}

float walk_cells(const GridMap& grid, const raycast::Ray& ray) {
  const double cells_per_m = 1.0 / grid.resolution_m;
  const double c = std::cos(grid.T_map_grid.theta_rad);
  const double s = std::sin(grid.T_map_grid.theta_rad);
  const double x_m = ray.x_m - grid.T_map_grid.x_m;
  const double y_m = ray.y_m - grid.T_map_grid.y_m;
  return static_cast<float>(grid.resolution_m *
                            raycast::walk_grid(testing::grid_view(grid), cells_per_m * (c * x_m + s * y_m),
                                               cells_per_m * (c * y_m - s * x_m), c * ray.dx + s * ray.dy,
                                               c * ray.dy - s * ray.dx, cells_per_m * ray.range_max_m));
}

bool agrees_with_oracle(const RayPlace& place) {
  if (!agrees(place, "scene", *place.scene) || !agrees(place, "embree", *place.embree)) return false;
  if (!cones_agree(place)) return false;
  if (place.distance_walk == nullptr) return true;
  return agrees(place, "distance_walk", *place.distance_walk) &&
         rays_agree(place, "grid_walk",
                    [&](std::span<const raycast::Ray> rays, std::vector<float>& ranges_m) {
                      for (std::size_t i = 0; i < rays.size(); ++i)
                        ranges_m[i] = walk_cells(place.grid, rays[i]);
                    });
}

std::vector<RayPlace> ray_places() {
  std::vector<RayPlace> all;
  all.push_back(make_place("office", office(), std::nullopt));
  if (!testing::has_data()) {
    std::fprintf(stderr, "no real data: set LANDFALL_DATA\n");
    return all;
  }
  for (const auto& [name, file] : {std::pair{"intel", "intel/map.yaml"},
                                   {"infinite_corridor", "infinite_corridor/map.yaml"},
                                   {"willow_garage", "maps/turtlebot_willow-2010-02-18-0.10.yaml"}})
    all.push_back(make_place(name, load_grid_map(testing::data_folder() / file), std::nullopt));
  const WallMap mall = load_wall_map(testing::data_folder() / "plans" / "mall_site1_F1.json");
  const GridMap drawn = to_grid(mall, {.resolution_m = 0.1, .outside_unknown = true});
  all.push_back(make_place("mall_plan", drawn, mall));
  all.push_back(make_place("mall_drawn_as_grid", drawn, std::nullopt));
  return all;
}

}  // namespace landfall::bench
