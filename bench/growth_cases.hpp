// The maps and scans of bench_growth, made when they are first needed: all of them together would fill the
// memory.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "landfall/prepared_map.hpp"
#include "landfall/scan.hpp"

namespace landfall::bench {

inline constexpr std::size_t scans_per_case = 11;

struct Question {
  PreparedMap map;
  Scan scan;
};

struct Case {
  std::string name;
  std::function<std::vector<Question>()> ask;  // scans_per_case of them
};

// Made-up floors, and offices whose rooms have all the same walls.
std::vector<Case> made_up_maps();
// From 45 to 1440 beams on one made-up floor.
std::vector<Case> beam_counts();
// Ever larger cuts of the map of infinite_corridor, each around the place of a real scan, the same scans each
// time; the whole buildings. None, with a message, where there are no data.
std::vector<Case> buildings();

}  // namespace landfall::bench
