// Every public header, and a search that needs the whole library behind it.
#include <cmath>
#include <cstdio>

#include "landfall/align.hpp"
#include "landfall/consistent.hpp"
#include "landfall/error.hpp"
#include "landfall/io.hpp"
#include "landfall/mapping.hpp"
#include "landfall/search.hpp"
#include "landfall/simulate.hpp"

int main() {
  const landfall::WallMap plan{
      {{{0, 0}, {6, 0}}, {{6, 0}, {6, 4}}, {{6, 4}, {2, 4}}, {{2, 4}, {0, 3}}, {{0, 3}, {0, 0}}}};
  const landfall::PreparedMap map{plan};
  const auto scanner = std::make_shared<const landfall::Sensor>(
      landfall::make_fan({.beams = 360, .first_rad = 0.0, .step_rad = std::numbers::pi / 180.0}));
  const landfall::Pose2 T_map_robot{1.5, 1.0, 0.3};
  const auto scans = landfall::simulate(map, scanner, std::span(&T_map_robot, 1));
  const auto result = landfall::search(map, landfall::PosePrior{landfall::Anywhere{}}, scans[0]);
  const bool right = !result.hypotheses.empty() &&
                     landfall::translation_distance(result.hypotheses[0].T_map_robot, T_map_robot) < 0.1;
  std::printf("%s: %s\n", result.method.c_str(), right ? "found" : "not found");
  return right ? 0 : 1;
}
