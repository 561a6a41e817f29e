#include "bench/way_report.hpp"

#include <algorithm>
#include <cstdio>

namespace landfall::bench {
namespace {

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

// NOLINTNEXTLINE(readability-identifier-naming): Google Benchmark's name
void WayReport::ReportRuns(const std::vector<Run>& runs) {
  to_.ReportRuns(runs);
  for (const Run& run : runs) {
    const std::string name = run.run_name.function_name;
    const std::size_t slash = name.rfind('/');
    const auto rate = run.counters.find("rays/s");
    // Where only aggregates are reported, the median stands for the repetitions that it is of.
    const bool counts = run.run_type == Run::RT_Iteration || run.aggregate_name == "median";
    if (!counts || slash == std::string::npos || rate == run.counters.end()) continue;
    Rates& rates = by_pattern_[name.substr(0, slash)][name.substr(slash + 1)];
    rates.chosen = run.counters.count("chosen") != 0;
    rates.rays_per_s.push_back(rate->second.value);
  }
}

void WayReport::print_choices() const {
  for (const auto& [pattern, ways] : by_pattern_) {
    if (ways.size() < 2) continue;
    std::string chosen = "none", fastest;
    double chosen_rate = 0.0, fastest_rate = 0.0;
    for (const auto& [way, rates] : ways) {
      const double rate = median(rates.rays_per_s);
      if (rates.chosen) chosen = way, chosen_rate = rate;
      if (rate > fastest_rate) fastest = way, fastest_rate = rate;
    }
    std::fprintf(stderr, "%s: chosen %s, %.0f %% of the fastest, %s at %.1f M rays/s\n", pattern.c_str(),
                 chosen.c_str(), 100.0 * chosen_rate / fastest_rate, fastest.c_str(), 1e-6 * fastest_rate);
  }
}

}  // namespace landfall::bench
