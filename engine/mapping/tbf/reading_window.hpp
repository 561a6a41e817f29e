// The sliding window of scans that new readings look back through. Ivanjko, Petrovic & Miklic 2005, section
// 4: a column for each scan; a new one discards the oldest.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "engine/mapping/tbf/sonar_reading.hpp"
#include "engine/mapping/tbf/triangulation.hpp"

namespace landfall::internal {

class ReadingWindow {
 public:
  // Of this many scans, the newest included; at least 1.
  explicit ReadingWindow(int scans);

  // The triangulation of a reading of the newest scan with those of all scans before it in the window,
  // swept backwards; none where no arc crosses its own.
  [[nodiscard]] std::optional<Triangulation> triangulate(const SonarReading& reading) const;
  // The scan after those so far.
  void push(std::span<const SonarReading> readings);

 private:
  // The readings of a scan, and a circle around each one's arc, by coordinate: most pairs end there.
  struct Column {
    std::vector<SonarReading> readings{};
    std::vector<double> middle_x_m{};
    std::vector<double> middle_y_m{};
    std::vector<double> reach_m{};
  };

  std::vector<Column> past_;  // a ring
  std::size_t newest_ = 0;
  std::size_t count_ = 0;
};

}  // namespace landfall::internal
