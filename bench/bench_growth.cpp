// How the time of a scan grows with the number of poses and with the number of beams: one thread, no prior,
// the lattice of 0.5 degrees and 5 cm. Poses, from 10^6 to 10^10: where the data are, real scans in ever
// larger cuts of the map of infinite_corridor around the place where each was taken, and the other buildings;
// made-up floors, and offices whose rooms have all the same walls. Beams: on one made-up floor. Branch and
// bound is held to exhaustive search on a coarse lattice in each case before anything is timed.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "bench/context.hpp"
#include "bench/floor.hpp"
#include "bench/office.hpp"
#include "engine/counter_rng.hpp"
#include "engine/lattice.hpp"
#include "landfall/io.hpp"
#include "landfall/search.hpp"
#include "landfall/simulate.hpp"
#include "tests/data_folder.hpp"

namespace landfall::bench {
namespace {

constexpr std::size_t scans_per_case = 11;
constexpr int usual_beams = 180;
constexpr double coarse_rotation_step_rad = std::numbers::pi / 6.0;  // 30 degrees
const PosePrior anywhere{Anywhere{}};

struct Question {
  PreparedMap map;
  Scan scan;
};

struct Case {
  std::string name;
  std::vector<Question> questions;
};

std::string cells_name(const std::string& kind, const GridMap& map) {
  return kind + "/cells:" + std::to_string(map.width_cells) + "x" + std::to_string(map.height_cells);
}

// Half a turn in so many beams, from random free poses.
std::vector<Question> look_around(const PreparedMap& map, int beams) {
  internal::CounterRng rng(1);
  const double side_m = map.grid().resolution_m * map.grid().width_cells;
  std::vector<Pose2> T_map_robot;
  while (T_map_robot.size() < scans_per_case) {
    const Pose2 pose{.x_m = side_m * rng.uniform(),
                     .y_m = side_m * rng.uniform(),
                     .theta_rad = 2.0 * std::numbers::pi * rng.uniform()};
    if (map.grid().at(map.grid().cell_of({pose.x_m, pose.y_m})) == Occupancy::free)
      T_map_robot.push_back(pose);
  }
  const auto sensor = std::make_shared<const Sensor>(
      make_fan({.beams = beams, .first_rad = -std::numbers::pi / 2.0, .step_rad = std::numbers::pi / beams}));
  std::vector<Question> questions;
  for (const Scan& scan : simulate(map, sensor, T_map_robot)) questions.push_back({map, scan});
  return questions;
}

Case made_up(const std::string& kind, const GridMap& map) {
  return {cells_name(kind, map), look_around(PreparedMap(map), usual_beams)};
}

// Larger ones of either take minutes: their rooms look much alike, so that rivals grow as the map does.
std::vector<Case> made_up_maps() {
  std::vector<Case> cases;
  for (const int side_cells : {38, 61, 121, 241, 481, 961, 1921})
    cases.push_back(made_up("floor", Floor::draw(side_cells)));
  for (const int rooms : {1, 2, 4, 8, 16, 32}) cases.push_back(made_up("office", office(rooms)));
  return cases;
}

std::vector<Case> beam_counts() {
  const PreparedMap map(Floor::draw(961));
  std::vector<Case> cases;
  for (const int beams : {45, 90, 180, 360, 720, 1440})
    cases.push_back({"beams/" + std::to_string(beams), look_around(map, beams)});
  return cases;
}

struct Building {
  PreparedMap map;
  std::vector<Scan> log;
  std::vector<StampedPose> truth;

  explicit Building(const std::string& name)
      : map(load_map(testing::data_folder() / name / "map.yaml")),
        log(load_log(testing::data_folder() / name / "query.log.gz").scans),
        truth(load_trajectory(testing::data_folder() / name / "truth.tum")) {}

  // Evenly spread over the log.
  [[nodiscard]] std::size_t query(std::size_t i) const { return i * (log.size() - 1) / (scans_per_case - 1); }
};

// So many cells around the point, moved to where the map has them all; the map where it has not so many.
GridMap cut_out(const GridMap& map, const Point2& p_map, int side_cells) {
  const CellIndex middle = map.cell_of(p_map);
  const int width = std::min(side_cells, map.width_cells);
  const int height = std::min(side_cells, map.height_cells);
  const int left = std::clamp(middle.col - width / 2, 0, map.width_cells - width);
  const int bottom = std::clamp(middle.row - height / 2, 0, map.height_cells - height);
  GridMap part{
      .width_cells = width,
      .height_cells = height,
      .resolution_m = map.resolution_m,
      .T_map_grid = map.T_map_grid *
                    Pose2{.x_m = left * map.resolution_m, .y_m = bottom * map.resolution_m, .theta_rad = 0.0},
      .cells = {}};
  for (int row = bottom; row < bottom + height; ++row) {
    const auto first = map.cells.begin() + static_cast<std::ptrdiff_t>(map.index({left, row}));
    part.cells.insert(part.cells.end(), first, first + width);
  }
  return part;
}

// The same scans each time.
std::vector<Case> cuts(const Building& building) {
  std::vector<Case> cases;
  for (const int side_cells : {38, 76, 152, 304, 608, 1216, 2432}) {
    Case one;
    for (std::size_t i = 0; i < scans_per_case; ++i) {
      const Pose2& T_map_robot = building.truth[building.query(i)].pose;
      one.questions.push_back(
          {PreparedMap(cut_out(building.map.grid(), {T_map_robot.x_m, T_map_robot.y_m}, side_cells)),
           building.log[building.query(i)]});
    }
    one.name = cells_name("cut", one.questions.front().map.grid());
    cases.push_back(std::move(one));
  }
  return cases;
}

Case whole(const std::string& name, const Building& building) {
  Case one{name, {}};
  for (std::size_t i = 0; i < scans_per_case; ++i)
    one.questions.push_back({building.map, building.log[building.query(i)]});
  return one;
}

std::vector<Case> buildings() {
  std::vector<Case> cases;
  if (!testing::has_data()) {
    std::fprintf(stderr, "no real data: set LANDFALL_DATA\n");
    return cases;
  }
  const Building corridor("infinite_corridor");
  cases = cuts(corridor);
  cases.push_back(whole(cells_name("cut", corridor.map.grid()), corridor));
  for (const char* name : {"intel", "csail", "aces", "acapulco", "infinite_corridor"})
    cases.push_back(whole("building/" + std::string(name), Building(name)));
  return cases;
}

std::int64_t best_score(const SearchResult& result) {
  std::int64_t best = 0;
  for (const Hypothesis& hypothesis : result.hypotheses) best = std::max(best, hypothesis.score);
  return best;
}

bool equals_exhaustive(const Case& one) {
  SearchOptions options{.rotation_step_rad = coarse_rotation_step_rad, .max_hypotheses = 8};
  const Question& middle = one.questions[scans_per_case / 2];
  options.method = "exhaustive";
  const SearchResult expected = search(middle.map, anywhere, middle.scan, options);
  options.method = "branch_and_bound";
  const SearchResult result = search(middle.map, anywhere, middle.scan, options);
  if (result.proven && best_score(result) == best_score(expected)) return true;
  std::fprintf(stderr, "%s: branch and bound scores %lld, exhaustive %lld\n", one.name.c_str(),
               static_cast<long long>(best_score(result)), static_cast<long long>(best_score(expected)));
  return false;
}

double median(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// Of the lattice, before the free-space mask.
double lattice_poses(const PreparedMap& map, const SearchOptions& options) {
  const GridMap& grid = map.grid();
  const int headings =
      internal::make_lattice(grid, options.translation_step_m, options.rotation_step_rad).headings;
  return static_cast<double>(headings) * static_cast<double>(grid.cells.size());
}

// An iteration is all of the case's scans, one after the other. Processor time of the one thread: the wall
// time of a quiet machine, on a busy one too.
void time_searches(benchmark::State& state, const Case& one) {
  const SearchOptions options{.method = "branch_and_bound", .threads = 1};
  for (const Question& question : one.questions) question.map.prepare();
  std::vector<double> search_ms;
  for (auto _ : state)
    for (const Question& question : one.questions) {
      const std::clock_t start = std::clock();
      const SearchResult result = search(question.map, anywhere, question.scan, options);
      search_ms.push_back(1e3 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
      if (!result.proven) state.SkipWithError("not proven");
      state.SetLabel(result.method);
    }
  state.counters["median_ms"] = median(search_ms);
  state.counters["poses"] = lattice_poses(one.questions.front().map, options);
  state.counters["beams"] = static_cast<double>(one.questions.front().scan.ranges_m.size());
}

bool register_cases(const std::vector<Case>& cases) {
  for (const Case& one : cases) {
    if (!equals_exhaustive(one)) return false;
    benchmark::RegisterBenchmark(one.name.c_str(), [&one](benchmark::State& state) {
      time_searches(state, one);
    })->Unit(benchmark::kMillisecond);
  }
  return true;
}

}  // namespace
}  // namespace landfall::bench

int main(int argc, char** argv) {
  using namespace landfall::bench;
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  name_instruction_set_and_executor();
  const std::vector<Case> all[] = {made_up_maps(), beam_counts(), buildings()};
  for (const std::vector<Case>& cases : all)
    if (!register_cases(cases)) return 1;
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}
