#include "bench/places.hpp"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <numbers>

#include "bench/office.hpp"
#include "engine/base/counter_rng.hpp"
#include "landfall/io.hpp"
#include "landfall/simulate.hpp"
#include "tests/data_folder.hpp"

namespace landfall::bench {

std::vector<Pose2> random_free_poses(const GridMap& map, std::size_t count) {
  internal::CounterRng rng(1);
  std::vector<Pose2> T_map_robot;
  while (T_map_robot.size() < count) {
    const Pose2 pose = map.T_map_grid * Pose2{.x_m = map.resolution_m * map.width_cells * rng.uniform(),
                                              .y_m = map.resolution_m * map.height_cells * rng.uniform(),
                                              .theta_rad = 2.0 * std::numbers::pi * rng.uniform()};
    if (map.at(map.cell_of({pose.x_m, pose.y_m})) == Occupancy::free) T_map_robot.push_back(pose);
  }
  return T_map_robot;
}

Place office_place() {
  const PreparedMap map(office());
  const auto sensor = std::make_shared<const Sensor>(
      make_fan({.beams = 180, .first_rad = -std::numbers::pi / 2.0, .step_rad = std::numbers::pi / 180.0}));
  return {"office", map, simulate(map, sensor, random_free_poses(map.grid(), scans_per_place))};
}

Place building_place(const std::string& name) {
  const std::filesystem::path folder = testing::data_folder() / name;
  const std::vector<Scan> log = load_log(folder / "query.log.gz").scans;
  Place place{name, load_map(folder / "map.yaml"), {}};
  for (std::size_t i = 0; i < scans_per_place; ++i)
    place.scans.push_back(log[i * (log.size() - 1) / (scans_per_place - 1)]);
  return place;
}

std::vector<Place> office_and(std::initializer_list<const char*> buildings) {
  std::vector<Place> all;
  all.push_back(office_place());
  if (!testing::has_data()) {
    std::fprintf(stderr, "no real data: set LANDFALL_DATA\n");
    return all;
  }
  for (const char* name : buildings) all.push_back(building_place(name));
  return all;
}

std::int64_t best_score(const SearchResult& result) {
  std::int64_t best = 0;
  for (const Hypothesis& hypothesis : result.hypotheses) best = std::max(best, hypothesis.score);
  return best;
}

double quantile(std::vector<double>& values, double share) {
  const auto at =
      values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

}  // namespace landfall::bench
