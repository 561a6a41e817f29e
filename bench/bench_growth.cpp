// How the time of a scan grows with the number of poses and with the number of beams: one thread, no prior,
// the lattice of 0.5 degrees and 5 cm. Poses, from 10^6 to 10^10: where the data are, real scans in ever
// larger cuts of the map of infinite_corridor around the place where each was taken, and the other buildings;
// made-up floors, and offices whose rooms have all the same walls. Beams: on one made-up floor. Branch and
// bound is held to exhaustive search on a coarse lattice in each case that is run, before it is timed.
#include <benchmark/benchmark.h>

#include <cstdio>
#include <map>
#include <numbers>
#include <string>
#include <vector>

#include "bench/context.hpp"
#include "bench/growth_cases.hpp"
#include "bench/places.hpp"
#include "engine/base/thread_time.hpp"
#include "engine/priors/lattice.hpp"
#include "landfall/search.hpp"

namespace landfall::bench {
namespace {

constexpr double coarse_rotation_step_rad = std::numbers::pi / 6.0;  // 30 degrees
const PosePrior anywhere{Anywhere{}};

bool equals_exhaustive(const std::string& name, const Question& question) {
  SearchOptions options{.rotation_step_rad = coarse_rotation_step_rad, .max_hypotheses = 8};
  options.method = "exhaustive";
  const SearchResult expected = search(question.map, anywhere, question.scan, options);
  options.method = "branch_and_bound";
  const SearchResult result = search(question.map, anywhere, question.scan, options);
  if (result.proven && best_score(result) == best_score(expected)) return true;
  std::fprintf(stderr, "%s: branch and bound scores %lld, exhaustive %lld\n", name.c_str(),
               static_cast<long long>(best_score(result)), static_cast<long long>(best_score(expected)));
  return false;
}

// The questions of the case that runs: the next case's maps take the place of its own.
class CaseAtWork {
 public:
  const std::vector<Question>& questions_of(const Case& one) {
    if (name_ != one.name) {
      questions_.clear();
      questions_ = one.ask();
      name_ = one.name;
      for (const Question& question : questions_) question.map.prepare();
    }
    return questions_;
  }
  // Asked once a case, of its questions.
  bool is_right(const Case& one) {
    const auto [known, is_new] = is_right_.try_emplace(one.name, false);
    if (is_new) known->second = equals_exhaustive(one.name, questions_of(one)[scans_per_case / 2]);
    if (!known->second) failed_ = true;
    return known->second;
  }
  void fail() { failed_ = true; }
  [[nodiscard]] bool failed() const { return failed_; }

 private:
  std::string name_;
  std::vector<Question> questions_;
  std::map<std::string, bool> is_right_;
  bool failed_ = false;
};

// Of the lattice, before the free-space mask.
double lattice_poses(const PreparedMap& map, const SearchOptions& options) {
  const GridMap& grid = map.grid();
  const int headings =
      internal::make_lattice(grid, options.translation_step_m, options.rotation_step_rad).headings;
  return static_cast<double>(headings) * static_cast<double>(grid.cells.size());
}

// One scan after the other; false where one is not proven. Time of this thread: on a quiet machine its wall
// time, and the same on a busy one.
bool search_all(const std::vector<Question>& questions, const SearchOptions& options,
                std::vector<double>& search_ms) {
  for (const Question& question : questions) {
    const double start_ms = internal::thread_time_ms();
    const SearchResult result = search(question.map, anywhere, question.scan, options);
    search_ms.push_back(internal::thread_time_ms() - start_ms);
    if (!result.proven) return false;
  }
  return true;
}

// An iteration is all of the case's scans.
void time_searches(benchmark::State& state, const Case& one, CaseAtWork& at_work) {
  const SearchOptions options{.method = "branch_and_bound", .threads = 1};
  if (!at_work.is_right(one)) {
    state.SkipWithError("not what exhaustive search finds");
    return;
  }
  const std::vector<Question>& questions = at_work.questions_of(one);
  std::vector<double> search_ms;
  for (auto _ : state) {
    if (search_all(questions, options, search_ms)) continue;
    at_work.fail();
    state.SkipWithError("not proven");
    break;
  }
  state.SetLabel(options.method);
  state.counters["median_ms"] = quantile(search_ms, 0.5);
  state.counters["poses"] = lattice_poses(questions.front().map, options);
  state.counters["beams"] = static_cast<double>(questions.front().scan.ranges_m.size());
}

}  // namespace
}  // namespace landfall::bench

int main(int argc, char** argv) {
  using namespace landfall::bench;
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  name_instruction_set_and_executor();
  CaseAtWork at_work;
  for (const std::vector<Case>& cases : {made_up_maps(), beam_counts(), buildings()})
    for (const Case& one : cases)
      benchmark::RegisterBenchmark(one.name.c_str(), [one, &at_work](benchmark::State& state) {
        time_searches(state, one, at_work);
      })->Unit(benchmark::kMillisecond);
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return at_work.failed() ? 1 : 0;
}
