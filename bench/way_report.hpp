// Watches the runs of bench_raycast, to say how far the chosen way is from the fastest.
#pragma once

#include <benchmark/benchmark.h>

#include <map>
#include <string>
#include <vector>

namespace landfall::bench {

// Passes everything on to Google Benchmark's own reporter. Benchmarks are called place/pattern/way.
class WayReport : public benchmark::BenchmarkReporter {
 public:
  explicit WayReport(benchmark::BenchmarkReporter& to) : to_(to) {}

  bool ReportContext(const Context& context) override { return to_.ReportContext(context); }
  void ReportRuns(const std::vector<Run>& runs) override;
  void Finalize() override { to_.Finalize(); }

  // A line on stderr per place and pattern that two ways or more ran: the chosen way's share of the fastest's
  // rate, both medians.
  void print_choices() const;

 private:
  struct Rates {
    bool chosen = false;
    std::vector<double> rays_per_s;
  };

  benchmark::BenchmarkReporter& to_;
  std::map<std::string, std::map<std::string, Rates>> by_pattern_;  // place/pattern -> way
};

}  // namespace landfall::bench
