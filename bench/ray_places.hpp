// The maps of bench_raycast, every way of casting rays over each, and the proof that all agree with an
// oracle.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "landfall/grid_map.hpp"
#include "raycast/distance_walk.hpp"
#include "raycast/scene.hpp"
#include "raycast/wall_trace.hpp"

namespace landfall::bench {

inline constexpr double range_max_m = 80.0;

struct RayPlace {
  std::string name;
  GridMap grid;
  bool has_own_walls = false;  // a plan: the grid only says where it is free
  std::vector<raycast::Segment> walls;
  std::shared_ptr<const raycast::Scene> scene;                 // what the engine uses
  std::shared_ptr<const raycast::WallTrace> embree;            // over the walls
  std::shared_ptr<const raycast::DistanceWalk> distance_walk;  // null: a plan
  std::vector<raycast::Pose> poses;                            // random, on free cells
};

// The office; where the data are, real maps, a mall's plan, and the grid drawn from it.
std::vector<RayPlace> ray_places();

std::vector<raycast::Beam> fan(int count, double step_rad, double half_angle_rad);
// 24 cones of 12 degrees.
std::vector<raycast::Beam> ring_of_cones();
// As many rays as a fan of 180 has per pose, in an order that has nothing in common.
std::vector<raycast::Ray> scattered_rays(const RayPlace& place);
// By the exact walk from cell to cell, in metres; grids alone.
float walk_cells(const GridMap& grid, const raycast::Ray& ray);

// Says on stderr what differs.
bool agrees_with_oracle(const RayPlace& place);

}  // namespace landfall::bench
