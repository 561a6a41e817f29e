// floor.yaml and drive.jsonl in the working folder: what the programs of README.md and docs/ read.
#include <memory>
#include <numbers>
#include <vector>

#include "landfall/io.hpp"
#include "landfall/simulate.hpp"

int main() {
  const landfall::WallMap plan{
      {{{0, 0}, {6, 0}}, {{6, 0}, {6, 4}}, {{6, 4}, {2, 4}}, {{2, 4}, {0, 3}}, {{0, 3}, {0, 0}}}};
  const landfall::GridMap floor = landfall::to_grid(plan);
  landfall::save_grid_map(floor, "floor.yaml");

  const auto scanner = std::make_shared<const landfall::Sensor>(
      landfall::make_fan({.beams = 360, .first_rad = 0.0, .step_rad = std::numbers::pi / 180.0}));
  const std::vector<landfall::Pose2> T_map_robot{{1.5, 1.1, 0.3}, {2.5, 1.1, 0.3}};
  auto scans = landfall::simulate(landfall::PreparedMap{floor}, scanner, T_map_robot);
  scans[1].stamp_s = 1.0;
  scans[0].T_odom_robot = landfall::Pose2{};
  scans[1].T_odom_robot = inverse(T_map_robot[0]) * T_map_robot[1];
  landfall::save_log(scans, "drive.jsonl");
}
